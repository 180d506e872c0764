#include "bench/problems/block_image.h"

#include <filesystem>

#include "common/record/volume.h"

namespace palpate::bench {

void write_block_image(const std::array<int, 3>& cells, double edge, const std::string& path) {
  constexpr int margin = 2;
  Volume volume;
  volume.source = "made";
  for (std::size_t a = 0; a < 3; ++a) volume.size[a] = cells[a] + 2 * margin;
  volume.source_size = volume.size;
  volume.spacing = {edge, edge, edge};
  const auto in = [&](std::size_t a, int n) { return n >= margin && n < volume.size[a] - margin; };
  for (int k = 0; k < volume.size[2]; ++k)
    for (int j = 0; j < volume.size[1]; ++j)
      for (int i = 0; i < volume.size[0]; ++i)
        volume.intensity.push_back(in(0, i) && in(1, j) && in(2, k) ? 100.0F : -100.0F);
  volume.transfer = grey_transfer(-100, 100);
  std::filesystem::remove(path);
  write_volume(volume, path);
}

}  // namespace palpate::bench
