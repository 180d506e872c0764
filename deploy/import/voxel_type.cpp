#include "deploy/import/voxel_type.h"

#include <bit>

namespace palpate {
namespace {

std::uint16_t two_bytes(const unsigned char* p, bool big_endian) {
  return static_cast<std::uint16_t>(big_endian ? p[0] << 8 | p[1] : p[1] << 8 | p[0]);
}

std::uint32_t four_bytes(const unsigned char* p, bool big_endian) {
  const std::uint32_t a = two_bytes(p, big_endian), b = two_bytes(p + 2, big_endian);
  return big_endian ? a << 16 | b : b << 16 | a;
}

}  // namespace

std::optional<VoxelType> voxel_type_named(const std::string& name) {
  for (const auto type : {VoxelType::uint8, VoxelType::int16, VoxelType::uint16, VoxelType::float32})
    if (name == name_of(type)) return type;
  return std::nullopt;
}

std::string name_of(VoxelType type) {
  switch (type) {
    case VoxelType::uint8:
      return "uint8";
    case VoxelType::int16:
      return "int16";
    case VoxelType::uint16:
      return "uint16";
    case VoxelType::float32:
      return "float32";
  }
  return "";
}

std::size_t bytes_of(VoxelType type) {
  switch (type) {
    case VoxelType::uint8:
      return 1;
    case VoxelType::int16:
    case VoxelType::uint16:
      return 2;
    case VoxelType::float32:
      return 4;
  }
  return 0;
}

void decode(const unsigned char* from, std::size_t n, VoxelType type, bool big_endian, float* to) {
  const std::size_t bytes = bytes_of(type);
  for (std::size_t i = 0; i < n; ++i, from += bytes) {
    switch (type) {
      case VoxelType::uint8:
        to[i] = from[0];
        break;
      case VoxelType::int16:
        to[i] = static_cast<std::int16_t>(two_bytes(from, big_endian));
        break;
      case VoxelType::uint16:
        to[i] = two_bytes(from, big_endian);
        break;
      case VoxelType::float32:
        to[i] = std::bit_cast<float>(four_bytes(from, big_endian));
        break;
    }
  }
}

}  // namespace palpate
