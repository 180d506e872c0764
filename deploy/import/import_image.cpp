#include "deploy/import/import_image.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <utility>

#include "common/error/error.h"
#include "common/math/hash.h"
#include "common/record/volume_check.h"
#include "deploy/import/image_format.h"
#include "deploy/import/itk_volume.h"
#include "deploy/import/memory_budget.h"
#include "deploy/import/meta_header.h"
#include "deploy/import/nifti_header.h"
#include "deploy/import/nrrd_header.h"
#include "deploy/import/phantom.h"
#include "deploy/import/read_dicom.h"
#include "deploy/import/read_inv3.h"

namespace palpate {
namespace {

std::uint64_t checksum_of(const std::vector<std::string>& files) {
  std::uint64_t hash = hash_seed;
  std::vector<char> bytes(1 << 20);
  for (const auto& name : files) {
    std::ifstream file(name, std::ios::binary);
    do {
      file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
      hash = hash_bytes(bytes.data(), static_cast<std::size_t>(file.gcount()), hash);
    } while (file);
  }
  return hash;
}

/// Through ITK, having looked at the header ourselves. `files` gets the data file of a header that has one.
Volume read_checked(const std::string& path, const ImageFacts& facts, ItkFormat format,
                    std::vector<std::string>& files) {
  if (!facts.data_file.empty()) files.push_back(facts.data_file);
  Volume volume = itk_volume(path, format);
  if (!facts.oriented) volume.orientation.reset();
  return volume;
}

Volume read_any(const ImportOptions& options, std::vector<std::string>& files) {
  const std::string& path = options.input;
  const ImageFormat format = image_format_of(path);
  if (options.raw.any() && format != ImageFormat::raw && format != ImageFormat::inr)
    throw InputError(
        path + ": tells its own size, spacing and type; leave out --size, --spacing-mm, --type and --header");
  files = {path};
  switch (format) {
    case ImageFormat::inv3:
      return read_inv3(path);
    case ImageFormat::nifti:
      return read_checked(path, check_nifti_header(path), ItkFormat::nifti, files);
    case ImageFormat::nrrd:
      return read_checked(path, check_nrrd_header(path), ItkFormat::nrrd, files);
    case ImageFormat::meta:
      return read_checked(path, check_meta_header(path), ItkFormat::meta, files);
    case ImageFormat::dicom:
      return read_dicom(path, files);
    case ImageFormat::raw:
      return read_raw(path, options.raw);
    case ImageFormat::inr:
      return read_inr(path, options.raw);
  }
  return {};
}

std::vector<TransferPoint> transfer_of(const std::string& name, const std::vector<float>& intensity) {
  if (name == "ct") return ct_transfer();
  const auto [lo, hi] = std::minmax_element(intensity.begin(), intensity.end());
  const auto a = static_cast<double>(*lo), b = static_cast<double>(*hi);
  return name == "grey" ? grey_transfer(a, b) : default_transfer(a, b);
}

std::uint64_t cells_of(const std::array<int, 3>& size) {
  std::uint64_t cells = 1;
  for (const int n : size) cells *= static_cast<std::uint64_t>(n);
  return cells;
}

Volume put_into(const std::optional<std::array<int, 3>>& partition, Volume volume) {
  if (!partition) return volume;
  const std::uint64_t now = volume.n_cells(), then = cells_of(*partition);
  declare_cells("--partition", std::max(now, then), 2 * sizeof(float));  // a copy, and the next axis
  declare_cells("--partition", then, written_bytes);
  return resample(volume, *partition);
}

Volume import_phantom(const ImportOptions& options) {
  const auto size = options.raw.size.value_or(
      std::array<std::int64_t, 3>{phantom_size[0], phantom_size[1], phantom_size[2]});
  const auto whole = check_size("--size", size);
  declare_cells("--size", cells_of(whole), written_bytes);
  Volume volume = aneurysm_phantom(whole);
  if (!options.transfer.empty()) volume.transfer = transfer_of(options.transfer, volume.intensity);
  return put_into(options.partition, std::move(volume));
}

}  // namespace

Volume import_image(const ImportOptions& options, std::vector<std::string>* made_of) {
  if (options.partition) {
    const auto& [nx, ny, nz] = *options.partition;
    check_cost("--partition", cells_of(check_size("--partition", {nx, ny, nz})), written_bytes);
  }
  if (options.phantom) return import_phantom(options);
  std::vector<std::string> files;
  Volume volume = read_any(options, files);
  check_intensity(options.input, volume.intensity);
  const std::filesystem::path input = std::filesystem::weakly_canonical(options.input);
  volume.source = input.filename().string();
  volume.source_checksum = checksum_of(files);
  volume.source_size = volume.size;
  if (made_of != nullptr) *made_of = files;
  volume.transfer = transfer_of(options.transfer, volume.intensity);
  return put_into(options.partition, std::move(volume));
}

}  // namespace palpate
