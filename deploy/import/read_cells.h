#pragma once
// The cells of an image out of a stream of bytes.

#include <array>
#include <string>
#include <vector>

#include "deploy/import/byte_stream.h"
#include "deploy/import/voxel_type.h"

namespace palpate {

/// How the cells lie in a stream: x fastest, then y, then z.
struct CellLayout {
  std::array<int, 3> size{};
  VoxelType type = VoxelType::int16;
  bool big_endian = false;
};

/// Reads exactly the cells of the layout. Memory grows with what is really there, a slice at a time.
/// @throws InputError: too few bytes, or some left over
std::vector<float> read_cells(ByteStream& stream, const std::string& where, const CellLayout& layout);

}  // namespace palpate
