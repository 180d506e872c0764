#pragma once
// Lumps of cells that are stepped on their own: those that share nodes.

#include <cstdint>
#include <span>
#include <vector>

#include "physics_node/step/lattice/fast_nodes.h"

namespace palpate::physics {

class FastLumps {
 public:
  /// @param number  of a storage cell: see FastNodes
  FastLumps(const Body& body, std::span<const Index> node, std::span<const std::int32_t> number);

  /// What acceleration each node has above that of its lump; of lumps with held nodes all of it. In place. [m/s^2]
  void subtract_mean(std::span<Vec3> acceleration) noexcept;
  /// Turns each lump whose nodes all move so that it loses a moment of momentum.
  /// @param place  of each node [m]; @param moment  of what it has too much [kg m^2/s]; @param change  of its velocity [m/s]
  void turn(std::span<const std::uint8_t> moves, std::span<const Vec3> place, std::span<const Vec3> moment,
            std::span<Vec3> change) noexcept;

 private:
  struct Lump {
    double mass = 0;
    bool held = false;  // some of its nodes are
    bool stands = false;
    Vec3 centre = Vec3::Zero(), sum = Vec3::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  // sum of m x x^T
  };
  Lump& of(std::size_t node) noexcept { return lumps_[static_cast<std::size_t>(lump_[node])]; }

  std::vector<Lump> lumps_;
  std::vector<std::int32_t> lump_;  // of each node
  std::vector<double> mass_;        // of each node [kg]
};

}  // namespace palpate::physics
