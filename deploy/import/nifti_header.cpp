#include "deploy/import/nifti_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "common/error/error.h"
#include "common/math/units.h"
#include "common/record/volume_check.h"
#include "deploy/import/byte_stream.h"

namespace palpate {
namespace {

constexpr std::size_t header_bytes = 348;

/// Byte positions in the header.
constexpr std::size_t at_dim = 40, at_datatype = 70, at_bitpix = 72, at_pixdim = 76, at_vox_offset = 108,
                      at_units = 123, at_qform = 252, at_sform = 254, at_place = 256, place_floats = 18;

class Header {
 public:
  Header(const std::string& path, ByteStream& stream) {
    const bool whole = stream.read(bytes_.data(), bytes_.size()) == bytes_.size();
    swap_ = get<std::int32_t>(0) != 348;
    if (!whole || get<std::int32_t>(0) != 348)
      throw InputError(path + ": is not NIfTI-1, or is truncated; name a whole .nii or .nii.gz file");
  }

  template <class T>
  T get(std::size_t at) const {
    std::array<unsigned char, sizeof(T)> raw{};
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(at), sizeof(T), raw.begin());
    if (swap_) std::reverse(raw.begin(), raw.end());
    T value{};
    std::memcpy(&value, raw.data(), sizeof(T));
    return value;
  }

  bool swapped() const { return swap_; }
  std::int64_t dim(std::size_t i) const { return get<std::int16_t>(at_dim + 2 * i); }
  double pixdim(std::size_t i) const { return static_cast<double>(get<float>(at_pixdim + 4 * i)); }

 private:
  std::array<unsigned char, header_bytes> bytes_{};
  bool swap_ = false;
};

/// Length of the header's unit of space [m]; 0 (not said) is taken as millimetres, as everybody does.
double metres_per_unit(const Header& header) {
  switch (header.get<std::uint8_t>(at_units) & 7) {
    case 1:
      return 1;
    case 3:
      return 1e-6;
    default:
      return m_from_mm(1);
  }
}

template <class T>
std::uint64_t count_not_finite(const std::vector<unsigned char>& bytes, std::size_t n, bool swap) {
  std::uint64_t count = 0;
  for (std::size_t at = 0; at + sizeof(T) <= n; at += sizeof(T)) {
    std::array<unsigned char, sizeof(T)> raw{};
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), sizeof(T), raw.begin());
    if (swap) std::reverse(raw.begin(), raw.end());
    T value{};
    std::memcpy(&value, raw.data(), sizeof(T));
    count += std::isfinite(value) ? 0 : 1;
  }
  return count;
}

/// The file must hold what it says, and numbers: the library makes zeros of what is missing or not finite.
void check_cells(const std::string& path, const Header& header, ByteStream& stream, std::uint64_t cells) {
  const double offset = static_cast<double>(header.get<float>(at_vox_offset));
  const std::size_t gap =
      offset >= header_bytes && offset < 1e6 ? static_cast<std::size_t>(offset) - header_bytes : 4;
  const auto bits =
      static_cast<std::uint64_t>(std::max<std::int16_t>(0, header.get<std::int16_t>(at_bitpix)));
  const auto type = header.get<std::int16_t>(at_datatype);
  const std::uint64_t wanted = cells * bits / 8;
  std::vector<unsigned char> bytes((gap / 8 + (1 << 15)) * 8);
  std::uint64_t held = 0, bad = 0;
  stream.read(bytes.data(), gap);
  for (std::size_t n = bytes.size(); n == bytes.size() && held < wanted; held += n) {
    n = stream.read(bytes.data(), bytes.size());
    if (type == 16) bad += count_not_finite<float>(bytes, n, header.swapped());
    if (type == 64) bad += count_not_finite<double>(bytes, n, header.swapped());
  }
  if (held < wanted)
    throw InputError(
        fmt::format("{}: holds {} bytes of the {} of its cells; fetch a whole copy", path, held, wanted));
  if (bad > 0)
    throw InputError(
        fmt::format("{}: {} of its values are not finite numbers; replace them first", path, bad));
}

/// Quaternion, offsets and rows of the two placements. Why: the library's decomposition of a matrix with a number that is not
/// finite, or overflows when squared, never ends.
void check_place(const std::string& path, const Header& header) {
  constexpr float largest = 1e9F;
  for (std::size_t i = 0; i < place_floats; ++i)
    if (const auto value = header.get<float>(at_place + 4 * i); !(std::abs(value) <= largest))
      throw InputError(fmt::format("{}: its placement holds the number {}; at most {:g} in size is sensible",
                                   path, value, largest));
}

}  // namespace

ImageFacts check_nifti_header(const std::string& path) {
  ByteStream stream(path, ByteStream::Kind::plain);
  const Header header(path, stream);
  bool flat = header.dim(0) < 3;
  for (std::size_t i = 4; i <= 7 && static_cast<std::int64_t>(i) <= header.dim(0); ++i)
    flat |= header.dim(i) > 1;
  if (flat || header.dim(0) > 7)
    throw InputError(
        fmt::format("{}: has {} axes; a three-dimensional image is wanted", path, header.dim(0)));
  const auto size = check_size(path, {header.dim(1), header.dim(2), header.dim(3)});
  const double unit = metres_per_unit(header);
  check_spacing(path, {unit * header.pixdim(1), unit * header.pixdim(2), unit * header.pixdim(3)});
  check_place(path, header);
  std::uint64_t cells = 1;
  for (const int n : size) cells *= static_cast<std::uint64_t>(n);
  check_cells(path, header, stream, cells);
  ImageFacts facts;
  facts.oriented = header.get<std::int16_t>(at_qform) > 0 || header.get<std::int16_t>(at_sform) > 0;
  return facts;
}

}  // namespace palpate
