#pragma once
// The kinds of numbers that raw images are made of.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace palpate {

enum class VoxelType { uint8, int16, uint16, float32 };

/// By its name: "uint8", "int16", "uint16", "float32".
std::optional<VoxelType> voxel_type_named(const std::string& name);
std::string name_of(VoxelType type);
std::size_t bytes_of(VoxelType type);

/// Turns `n` stored numbers into floats. `from` needs no alignment. Every int16 and uint16 is exact as a float.
void decode(const unsigned char* from, std::size_t n, VoxelType type, bool big_endian, float* to);

}  // namespace palpate
