#include "physics_node/body/border_cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "common/scene/body_spec.h"
#include "physics_node/body/solid_shape.h"

namespace palpate::physics {
namespace {

/// Is there tissue at a place of the world?
class Tissue {
 public:
  Tissue(const BodySpec& body, const Cells& cells)
      : body_(body), image_(std::get_if<VolumeShape>(&body.shape)), cells_(cells) {}

  bool at(const Vec3& p) const {
    for (const CavitySpec& cavity : body_.cavities)
      if (std::visit([&p](const auto& where) { return holds(where, p); }, cavity.where)) return false;
    if (image_ == nullptr) return holds(body_, p - body_.at, 0.0);
    const double intensity = intensity_between(cells_, p);
    return intensity >= image_->keep_min && intensity <= image_->keep_max;
  }

  /// Of all of a cell, where its neighbours tell: what lies between intensities that are all kept, or all too low or too high, is so too.
  std::optional<bool> in_all_of(const Vec3i& cell) const {
    if (image_ == nullptr || !body_.cavities.empty()) return std::nullopt;
    bool kept = true, below = true, above = true;
    for (int n = 0; n < 27; ++n) {
      const Vec3i at = (cell + Vec3i(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1))
                           .cwiseMax(0)
                           .cwiseMin(cells_.size - Vec3i::Ones());
      const auto intensity = static_cast<double>(cells_.intensity[cells_.index(at.x(), at.y(), at.z())]);
      below = below && intensity < image_->keep_min - rounding(image_->keep_min);
      above = above && intensity > image_->keep_max + rounding(image_->keep_max);
      kept = kept && intensity >= image_->keep_min + rounding(image_->keep_min) &&
             intensity <= image_->keep_max - rounding(image_->keep_max);
    }
    if (kept) return true;
    return below || above ? std::optional(false) : std::nullopt;
  }

  int looks() const { return image_ != nullptr ? 4 : 16; }  // along an edge

 private:
  /// Why: a mean of equal numbers may lie a little beside them.
  static double rounding(double of) { return 1e-9 * (1 + std::abs(of)); }

  const BodySpec& body_;
  const VolumeShape* image_;
  const Cells& cells_;
};

/// At n^3 places, which all lie at another distance from each face of the cell: of a grid along the axes n^2 would lie in a plane
/// together, and a face of a box would be off by up to 1 / 2n of a cell.
double share_of(const Cells& cells, const Tissue& tissue, const Vec3& centre) {
  const auto in_tissue = [&](const Vec3& from_centre) {
    return tissue.at(centre + cells.spacing.cwiseProduct(from_centre)) ? 1 : 0;
  };
  // Just inside its faces, which may lie on those of the shape.
  constexpr double to_face = 0.5 - 1e-6;
  int inside = 0;
  for (int i = 0; i < 125; ++i)
    inside += in_tissue(Vec3(i % 5, i / 5 % 5, i / 25) * (to_face / 2) - Vec3::Constant(to_face));
  if (inside == 0 || inside == 125) return inside / 125;
  const int n = tissue.looks();
  const auto along = [n](int first, int second, int third) {
    return (first + (second + (third + 0.5) / n) / n) / n - 0.5;
  };
  inside = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) inside += in_tissue({along(i, j, k), along(j, k, i), along(k, i, j)});
  return inside / std::pow(n, 3);
}

/// May a cell that is not seen hold tissue of this body? It must lie at one that moves; what the image keeps but not the
/// body, being of another piece of it, must not come back.
bool may_hold(const BodySpec& body, const Cells& cells, const Vec3i& at) {
  if (cells.filled[cells.index(at.x(), at.y(), at.z())] != 0) return false;
  if (const auto* image = std::get_if<VolumeShape>(&body.shape)) {
    const auto own = static_cast<double>(cells.intensity[cells.index(at.x(), at.y(), at.z())]);
    const bool carved = std::any_of(body.cavities.begin(), body.cavities.end(), [&](const CavitySpec& c) {
      return std::visit(
          [&](const auto& where) { return holds(where, cells.centre_of(at.x(), at.y(), at.z())); }, c.where);
    });
    if (!carved && own >= image->keep_min && own <= image->keep_max) return false;
  }
  for (int n = 0; n < 27; ++n)
    if (cells.is_deformable(at.x() + n % 3 - 1, at.y() + n / 3 % 3 - 1, at.z() + n / 9 - 1)) return true;
  return false;
}

struct Sliver {
  Vec3i cell;
  float share;
};

/// Gives it to the cells across its faces or, where none of these moves, across its edges and corners.
void give_away(const Sliver& sliver, Cells& cells) {
  for (int apart = 1; apart <= 3; ++apart) {
    std::array<std::size_t, 26> to;
    std::size_t n = 0;
    for (int s = 0; s < 27; ++s) {
      const Vec3i step(s % 3 - 1, s / 3 % 3 - 1, s / 9 - 1), other = sliver.cell + step;
      if (step.cwiseAbs().sum() == apart && cells.share_of(other.x(), other.y(), other.z()) > 0)
        to[n++] = cells.index(other.x(), other.y(), other.z());
    }
    for (std::size_t c = 0; c < n; ++c) cells.share[to[c]] += sliver.share / static_cast<float>(n);
    if (n > 0) return;
  }
}

}  // namespace

double intensity_between(const Cells& cells, const Vec3& p) {
  const Vec3 in_cells = ((p - cells.corner).array() / cells.spacing.array() - 0.5).matrix();
  double sum = 0;
  const Vec3 lowest = in_cells.array().floor();
  const Vec3 t = in_cells - lowest;
  for (int c = 0; c < 8; ++c) {
    const Vec3i step(c & 1, c >> 1 & 1, c >> 2);
    const Vec3i cell = (lowest.cast<int>() + step).cwiseMax(0).cwiseMin(cells.size - Vec3i::Ones());
    double weight = 1;
    for (int a = 0; a < 3; ++a) weight *= step[a] != 0 ? t[a] : 1 - t[a];
    sum += weight * static_cast<double>(cells.intensity[cells.index(cell.x(), cell.y(), cell.z())]);
  }
  return sum;
}

void fill_border_cells(const BodySpec& body, Cells& cells) {
  const Tissue tissue(body, cells);
  std::vector<Sliver> slivers;
  cells.share.assign(cells.filled.size(), 0.0F);
  for (int k = 0; k < cells.size.z(); ++k)
    for (int j = 0; j < cells.size.y(); ++j)
      for (int i = 0; i < cells.size.x(); ++i) {
        const bool seen = cells.is_deformable(i, j, k);
        if (!seen && !may_hold(body, cells, {i, j, k})) continue;
        const std::optional<bool> all = tissue.in_all_of({i, j, k});
        const auto share = all ? (*all ? 1.0F : 0.0F)
                               : static_cast<float>(share_of(cells, tissue, cells.centre_of(i, j, k)));
        if (seen || share >= least_share)
          cells.share[cells.index(i, j, k)] = std::max(share, least_share);
        else if (share > 0)
          slivers.push_back({{i, j, k}, share});
      }
  for (const Sliver& sliver : slivers) give_away(sliver, cells);
}

}  // namespace palpate::physics
