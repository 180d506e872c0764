#include "deploy/import/inr_header.h"

#include <charconv>
#include <map>
#include <sstream>
#include <string_view>

#include "common/error/error.h"
#include "common/math/units.h"
#include "common/record/volume_check.h"

namespace palpate {
namespace {

constexpr std::size_t block = 256;
constexpr std::size_t blocks_limit = 64;
constexpr std::string_view beginning = "#INRIMAGE-4#{";

using Keys = std::map<std::string, std::string>;

Keys read_keys(ByteStream& stream, const std::string& where, std::size_t& bytes) {
  std::string text;
  while (text.find("##}") == std::string::npos) {
    std::string more(block, '\0');
    const bool whole = stream.read(reinterpret_cast<unsigned char*>(more.data()), block) == block;
    if (!whole || (text.empty() && !more.starts_with(beginning)) || text.size() >= block * blocks_limit)
      throw InputError(where + ": its INRIMAGE-4 header does not end; fetch a whole copy");
    text += more;
  }
  bytes = text.size();
  Keys keys;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto equals = line.find('=');
    if (equals != std::string::npos) keys[line.substr(0, equals)] = line.substr(equals + 1);
  }
  return keys;
}

/// The number at the beginning of a value, such as the 8 of "8 bits".
double number_of(const std::string& where, const Keys& keys, const std::string& key) {
  double number = 0;
  const auto found = keys.find(key);
  if (found == keys.end()) throw InputError(where + ": its header lacks " + key + "; add it");
  const auto& text = found->second;
  if (std::from_chars(text.data(), text.data() + text.size(), number).ec != std::errc())
    throw InputError(where + ": its header has " + key + "=" + text + "; a number is wanted");
  return number;
}

VoxelType type_of(const std::string& where, const Keys& keys) {
  const auto found = keys.find("TYPE");
  const std::string kind = found == keys.end() ? "" : found->second;
  const double bits = number_of(where, keys, "PIXSIZE");
  if (kind == "unsigned fixed" && bits == 8) return VoxelType::uint8;
  if (kind == "unsigned fixed" && bits == 16) return VoxelType::uint16;
  if (kind == "signed fixed" && bits == 16) return VoxelType::int16;
  if (kind == "float" && bits == 32) return VoxelType::float32;
  throw InputError(where + ": its cells are \"" + kind + "\" of " + keys.at("PIXSIZE") +
                   "; unsigned fixed of 8 or 16 bits, signed fixed of 16 and float of 32 are read");
}

bool big_endian(const std::string& where, const Keys& keys) {
  const auto found = keys.find("CPU");
  const std::string cpu = found == keys.end() ? "" : found->second;
  if (cpu == "sun" || cpu == "sgi") return true;
  if (cpu == "decm" || cpu == "alpha" || cpu == "pc") return false;
  throw InputError(where + ": its header has CPU=" + cpu + "; decm, alpha, pc, sun and sgi are known");
}

}  // namespace

bool has_inr_header(const std::string& path) {
  ByteStream stream(path, ByteStream::Kind::plain);
  std::string first(beginning.size(), '\0');
  stream.read(reinterpret_cast<unsigned char*>(first.data()), first.size());
  return first == beginning;
}

InrHeader read_inr_header(ByteStream& stream, const std::string& where) {
  InrHeader header;
  const Keys keys = read_keys(stream, where, header.bytes);
  std::array<std::int64_t, 3> size{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string letter(1, "XYZ"[axis]);
    const double n = number_of(where, keys, letter + "DIM");
    size[axis] = n >= 1 && n <= 1e9 ? static_cast<std::int64_t>(n) : 0;
    header.spacing[static_cast<int>(axis)] = m_from_mm(number_of(where, keys, "V" + letter));
  }
  header.layout.size = check_size(where, size);
  check_spacing(where, header.spacing);
  if (number_of(where, keys, "VDIM") != 1)
    throw InputError(where + ": has several values a cell; one is wanted (VDIM=1)");
  header.layout.type = type_of(where, keys);
  header.layout.big_endian = big_endian(where, keys);
  return header;
}

}  // namespace palpate
