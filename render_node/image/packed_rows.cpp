#include "render_node/image/packed_rows.h"

#include <libdeflate.h>

#include <algorithm>
#include <memory>
#include <new>

namespace palpate::render {
namespace {

constexpr int fastest = 1;
constexpr std::uint8_t as_it_is = 0, less_above = 2;  // filters of a row

struct Free {
  void operator()(libdeflate_compressor* one) const { libdeflate_free_compressor(one); }
};

std::vector<std::uint8_t> filtered(const Image& image) {
  const auto row = static_cast<std::size_t>(image.width) * 3;
  std::vector<std::uint8_t> all((row + 1) * static_cast<std::size_t>(image.height));
  for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y) {
    std::uint8_t* out = all.data() + y * (row + 1);
    const std::uint8_t* here = image.rgb.data() + y * row;
    *out++ = y == 0 ? as_it_is : less_above;
    if (y == 0) {
      std::copy_n(here, row, out);
      continue;
    }
    for (std::size_t i = 0; i < row; ++i) out[i] = static_cast<std::uint8_t>(here[i] - here[i - row]);
  }
  return all;
}

}  // namespace

std::vector<std::uint8_t> packed_rows(const Image& image) {
  const std::vector<std::uint8_t> rows = filtered(image);
  const std::unique_ptr<libdeflate_compressor, Free> compressor(libdeflate_alloc_compressor(fastest));
  if (!compressor) throw std::bad_alloc();
  std::vector<std::uint8_t> packed(libdeflate_zlib_compress_bound(compressor.get(), rows.size()));
  packed.resize(
      libdeflate_zlib_compress(compressor.get(), rows.data(), rows.size(), packed.data(), packed.size()));
  return packed;
}

}  // namespace palpate::render
