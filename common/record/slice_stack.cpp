#include "common/record/slice_stack.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "common/error/error.h"
#include "common/math/hash.h"
#include "common/record/png_file.h"
#include "common/record/volume_check.h"

namespace palpate {

Volume read_slices(const std::vector<std::string>& files, const Eigen::Vector3d& spacing) {
  PALPATE_CHECK(!files.empty(), "a stack has slices");
  check_spacing(files.front(), spacing);
  Volume volume;
  volume.spacing = spacing;
  volume.source = std::filesystem::path(files.front()).filename().string();
  int bits = 0;
  for (const auto& file : files) {
    const GreyPicture picture = read_grey_png(file);
    if (bits == 0) {
      bits = picture.bits;
      volume.size =
          check_size(file, {picture.width, picture.height, static_cast<std::int64_t>(files.size())});
      volume.intensity.reserve(volume.n_cells());
    }
    if (picture.width != volume.size[0] || picture.height != volume.size[1] || picture.bits != bits)
      throw InputError(fmt::format(
          "{}: is {} x {} pixels of {} bits, but the first slice is {} x {} of {}; slices of one body must "
          "be alike",
          file, picture.width, picture.height, picture.bits, volume.size[0], volume.size[1], bits));
    for (int y = picture.height - 1; y >= 0; --y)
      for (int x = 0; x < picture.width; ++x)
        volume.intensity.push_back(static_cast<float>(picture.at(x, y)));
    volume.source_checksum = hash_bytes(picture.value.data(), picture.value.size() * sizeof(picture.value[0]),
                                        volume.source_checksum);
  }
  volume.source_size = volume.size;
  const auto [lo, hi] = std::minmax_element(volume.intensity.begin(), volume.intensity.end());
  volume.transfer = grey_transfer(static_cast<double>(*lo), static_cast<double>(*hi));
  return volume;
}

}  // namespace palpate
