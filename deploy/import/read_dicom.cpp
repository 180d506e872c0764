#include "deploy/import/read_dicom.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "common/error/error.h"
#include "deploy/import/dicom_length.h"
#include "deploy/import/image_format.h"
#include "deploy/import/itk_volume.h"
#include "deploy/import/memory_budget.h"
#include "deploy/import/stack_slices.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;

// Why: cells as slices, as a volume (4 each) and as it is written (2), and what the next slice is read with.
constexpr double stacked_bytes = 12;

bool holds(const DicomSeries& series, const std::string& file) {
  return std::any_of(series.files.begin(), series.files.end(),
                     [&](const std::string& name) { return fs::equivalent(name, file); });
}

std::vector<std::string> dicom_files_in(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file() && looks_like_dicom(entry.path().string()))
      files.push_back(entry.path().string());
  return files;
}

/// A file that means to be DICOM but is in no series would leave a hole in the volume: nothing is left out silently.
void check_none_lost(const std::vector<std::string>& files, const std::vector<DicomSeries>& all) {
  for (const auto& file : files)
    if (std::none_of(all.begin(), all.end(), [&](const DicomSeries& series) { return holds(series, file); }))
      throw InputError(
          file + ": cannot be read as DICOM, damaged or not an image; fetch a whole copy, or move it away");
}

DicomSeries wanted_series(const std::string& path) {
  const bool whole_folder = fs::is_directory(path);
  const std::string folder = whole_folder ? path : fs::absolute(path).parent_path().string();
  const auto files = dicom_files_in(folder);
  for (const auto& file : files) check_dicom_length(file);
  const auto all = dicom_series_in(folder);
  check_none_lost(files, all);
  if (whole_folder && all.empty())
    throw InputError(path + ": there is no DICOM in this folder; name one that has some");
  if (whole_folder && all.size() > 1)
    throw InputError(path + ": holds " + std::to_string(all.size()) +
                     " series; name one file of the series wanted, such as " + all.front().files.front());
  for (const auto& series : all)
    if (whole_folder || holds(series, path)) return series;
  throw InputError(path + ": cannot be read as DICOM, damaged or truncated; fetch a whole copy");
}

}  // namespace

Volume read_dicom(const std::string& path, std::vector<std::string>& files) {
  const DicomSeries series = wanted_series(path);
  std::vector<Slice> slices;
  for (const auto& file : series.files) {
    slices.push_back({file, itk_volume(file, ItkFormat::dicom)});
    if (slices.size() == 1 && series.files.size() > 1)  // the others, and the stack of them
      declare_cells(path, slices.front().volume.n_cells() * series.files.size(), stacked_bytes);
  }
  if (slices.size() == 1 && slices.front().volume.size[2] > 1) {  // many slices in one file
    files = series.files;
    return std::move(slices.front().volume);
  }
  sort_slices(slices);
  files.clear();
  for (const auto& slice : slices) files.push_back(slice.file);
  return stack_slices(path, slices);
}

}  // namespace palpate
