#pragma once
// Where the air round a patient ends and tissue begins in an image, from its histogram.

#include <optional>
#include <vector>

namespace palpate::deploy {

struct AirThreshold {
  double intensity = 0;            // tissue has more
  double air = 0, tissue = 0;      // means of the darkest class and of the one above it
  double lowest = 0, highest = 0;  // of the image
};

/// Otsu's classes, of which the darkest is air: three, or two where that gives no valley; two of CT in Hounsfield
/// units, where what is denser than 300 HU counts as 300. Then once more two, with what is brighter than the mean of
/// tissue counting as that mean.
/// Why Otsu and no valley: his threshold lies halfway between the means of two classes, which is the intensity of a
/// cell half full of tissue, so the surface comes to lie where it is. The valley of CT is a plain of 800 HU without a
/// lowest point. Why three, and once more: a bright tissue would pull the threshold up, and what a weak coil leaves
/// dark falls to the air. Why 300 HU: bone and metal would pull likewise.
/// @return nothing where the histogram has no valley between air and tissue: all is one, or all is tissue
/// Cost: two passes, and one over at most 4 million cells. Source: Otsu 1979, "A threshold selection method from
/// gray-level histograms".
std::optional<AirThreshold> air_threshold(const std::vector<float>& intensity);

}  // namespace palpate::deploy
