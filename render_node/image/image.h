#pragma once
// A picture in memory.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpate::render {

struct Image {
  int width = 0, height = 0;      // [px]
  std::vector<std::uint8_t> rgb;  // top row first (height x width x 3)

  const std::uint8_t* at(int x, int y) const {
    return rgb.data() +
           (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * 3;
  }
};

}  // namespace palpate::render
