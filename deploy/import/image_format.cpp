#include "deploy/import/image_format.h"

#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <utility>

#include "common/error/error.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::pair<std::string_view, ImageFormat>, 11> endings = {
    {{".inv3", ImageFormat::inv3},
     {".nii", ImageFormat::nifti},
     {".nii.gz", ImageFormat::nifti},
     {".nrrd", ImageFormat::nrrd},
     {".nhdr", ImageFormat::nrrd},
     {".mha", ImageFormat::meta},
     {".mhd", ImageFormat::meta},
     {".raw", ImageFormat::raw},
     {".raw.gz", ImageFormat::raw},
     {".inr", ImageFormat::inr},
     {".inr.gz", ImageFormat::inr}}};

std::string lower_name(const std::string& path) {
  std::string name = fs::path(path).filename().string();
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

}  // namespace

bool looks_like_dicom(const std::string& path) {
  const std::string name = lower_name(path);
  if (name == "dicomdir") return false;
  if (name.ends_with(".dcm")) return true;
  std::array<char, 132> start{};
  std::ifstream file(path, std::ios::binary);
  file.read(start.data(), start.size());
  return file && std::string_view(start.data() + 128, 4) == "DICM";
}

ImageFormat image_format_of(const std::string& path) {
  std::error_code trouble;
  const auto status = fs::status(path, trouble);
  if (!fs::exists(status)) throw InputError(path + ": there is no such file or folder; name an image");
  if (fs::is_directory(status)) return ImageFormat::dicom;
  if (!fs::is_regular_file(status))
    throw InputError(path + ": is neither a file nor a folder; name an image");
  if (!std::ifstream(path)) throw InputError(path + ": may not be read; ask its owner for the right to");
  if (fs::file_size(path) == 0) throw InputError(path + ": is empty; fetch a whole copy");
  const std::string name = lower_name(path);
  for (const auto& [ending, format] : endings)
    if (name.ends_with(ending)) return format;
  if (looks_like_dicom(path)) return ImageFormat::dicom;
  throw InputError(path +
                   ": is of no known kind; .inv3, .nii, .nrrd, .nhdr, .mha, .mhd, .raw, .inr, DICOM files "
                   "and folders are read");
}

}  // namespace palpate
