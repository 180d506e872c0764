#pragma once
// What a volume file says about itself, without its cells.

#include <Eigen/Core>
#include <array>
#include <string>

namespace palpate {

struct VolumeFacts {
  std::array<int, 3> size{};            // cells along x, y, z
  Eigen::Vector3d spacing = {0, 0, 0};  // of the cells [m]
};

/// Cost: that of opening the file. @throws InputError as read_volume()
VolumeFacts volume_facts(const std::string& path);

}  // namespace palpate
