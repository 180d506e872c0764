#pragma once
// PNG files of every kind, made by libpng itself.

#include <cstdint>
#include <functional>
#include <string>

namespace palpate::test {

enum class PngKind { grey, rgb, palette, grey_alpha, rgb_alpha };

struct PngRecipe {
  int width = 5, height = 4;
  PngKind kind = PngKind::grey;
  int bits = 8;  // of a channel; palette: of an index
  bool interlaced = false;
};

/// @param value  of channel c at (x, y), as many bits as the recipe says. A palette shows index n as (n, 2 n, 3 n).
void make_png(const std::string& path, const PngRecipe& recipe,
              const std::function<unsigned(int, int, int)>& value);

}  // namespace palpate::test
