#include "render_node/image/packed_rows.h"

#include <libdeflate.h>

#include <algorithm>
#include <memory>
#include <new>

namespace palpate::render {
namespace {

constexpr int fastest = 1;
constexpr std::uint8_t as_it_is = 0, less_above = 2;  // filters of a row

void filter(const Image& image, std::vector<std::uint8_t>& rows) {
  const auto row = static_cast<std::size_t>(image.width) * 3;
  rows.resize((row + 1) * static_cast<std::size_t>(image.height));
  for (std::size_t y = 0; y < static_cast<std::size_t>(image.height); ++y) {
    std::uint8_t* out = rows.data() + y * (row + 1);
    const std::uint8_t* here = image.rgb.data() + y * row;
    *out++ = y == 0 ? as_it_is : less_above;
    if (y == 0) {
      std::copy_n(here, row, out);
      continue;
    }
    for (std::size_t i = 0; i < row; ++i) out[i] = static_cast<std::uint8_t>(here[i] - here[i - row]);
  }
}

}  // namespace

struct RowPacker::Compressor {
  Compressor() : one(libdeflate_alloc_compressor(fastest)) {
    if (one == nullptr) throw std::bad_alloc();
  }
  ~Compressor() { libdeflate_free_compressor(one); }
  Compressor(const Compressor&) = delete;
  Compressor& operator=(const Compressor&) = delete;
  libdeflate_compressor* one;
};

RowPacker::RowPacker() : compressor_(std::make_unique<Compressor>()) {}
RowPacker::~RowPacker() = default;
RowPacker::RowPacker(RowPacker&&) noexcept = default;

std::span<const std::uint8_t> RowPacker::pack(const Image& image) {
  filter(image, rows_);
  packed_.resize(libdeflate_zlib_compress_bound(compressor_->one, rows_.size()));
  const std::size_t n =
      libdeflate_zlib_compress(compressor_->one, rows_.data(), rows_.size(), packed_.data(), packed_.size());
  return std::span(packed_).first(n);
}

}  // namespace palpate::render
