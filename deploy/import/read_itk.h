#pragma once
// The one door to ITK. Nothing of it shows here, and it prints nothing.
// Why no Eigen here: ITK brings an older Eigen of its own; the two cannot meet in one file.

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace palpate {

enum class ItkFormat { nifti, nrrd, meta, dicom };

/// What a header says, in ITK's words: millimetres, LPS.
struct ItkHeader {
  std::vector<std::int64_t> size;  // one number an axis
  std::array<double, 3> spacing_mm{};
  std::array<double, 3> origin_mm{};
  std::array<double, 9>
      direction{};          // rows; the columns are the directions of x, y, z; identity where not given
  unsigned components = 1;  // values a cell
};

/// Reads one file: the header, which `check` may refuse by throwing, and then its cells, x fastest.
/// @throws InputError: damaged or truncated; what `check` throws
std::vector<float> read_itk(const std::string& path, ItkFormat format,
                            const std::function<void(const ItkHeader&)>& check);

/// A series of DICOM files in one folder.
struct DicomSeries {
  std::string id;
  std::vector<std::string> files;
};

/// All series in the folder, not below it. @throws InputError
std::vector<DicomSeries> dicom_series_in(const std::string& folder);

}  // namespace palpate
