#include "physics_node/step/lattice/fast_lumps.h"

#include <Eigen/LU>
#include <algorithm>
#include <numeric>

#include "physics_node/step/lattice/hex_grid.h"

namespace palpate::physics {
namespace {

/// Representative of a set, in a forest of them.
std::int32_t representative(const std::vector<std::int32_t>& parent, std::int32_t n) {
  while (parent[static_cast<std::size_t>(n)] != n) n = parent[static_cast<std::size_t>(n)];
  return n;
}

}  // namespace

FastLumps::FastLumps(const Body& body, std::span<const Index> node, std::span<const std::int32_t> number) {
  std::vector<std::int32_t> parent(node.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const Index cell : body.solid->fast.cells) {
    std::int32_t least = -1;
    for (const Index corner : corners_of_cell(body.lattice, cell)) {
      const std::int32_t one = representative(parent, number[static_cast<std::size_t>(corner)]);
      if (least >= 0) parent[static_cast<std::size_t>(std::max(least, one))] = std::min(least, one);
      least = least < 0 ? one : std::min(least, one);
    }
  }
  std::vector<std::int32_t> lump_at(node.size(), -1);
  for (std::size_t n = 0; n < node.size(); ++n) {
    std::int32_t& lump =
        lump_at[static_cast<std::size_t>(representative(parent, static_cast<std::int32_t>(n)))];
    if (lump < 0) lump = static_cast<std::int32_t>(lumps_.size()), lumps_.emplace_back();
    lump_.push_back(lump);
    const auto c = static_cast<std::size_t>(node[n]);
    mass_.push_back(body.solid->mass[c]);
    of(n).held = of(n).held || body.inverse_mass[c] == 0;
  }
}

void FastLumps::subtract_mean(std::span<Vec3> acceleration) noexcept {
  for (Lump& lump : lumps_) lump.sum.setZero(), lump.mass = 0;
  for (std::size_t n = 0; n < mass_.size(); ++n) {
    of(n).mass += mass_[n];
    of(n).sum += mass_[n] * acceleration[n];
  }
  for (std::size_t n = 0; n < mass_.size(); ++n)
    if (!of(n).held) acceleration[n] -= of(n).sum / of(n).mass;
}

void FastLumps::turn(std::span<const std::uint8_t> moves, std::span<const Vec3> place,
                     std::span<const Vec3> moment, std::span<Vec3> change) noexcept {
  for (Lump& lump : lumps_) {
    lump.mass = 0, lump.stands = lump.held;
    lump.centre.setZero(), lump.sum.setZero(), lump.second.setZero();
  }
  for (std::size_t n = 0; n < mass_.size(); ++n) {
    Lump& lump = of(n);
    lump.stands = lump.stands || moves[n] == 0;
    lump.mass += mass_[n];
    lump.centre += mass_[n] * place[n];
    lump.second += mass_[n] * place[n] * place[n].transpose();
    lump.sum += moment[n];
  }
  for (Lump& lump : lumps_) {
    lump.centre /= lump.mass;
    lump.second -= lump.mass * lump.centre * lump.centre.transpose();
    const Eigen::Matrix3d inertia = lump.second.trace() * Eigen::Matrix3d::Identity() - lump.second;
    lump.sum = -inertia.inverse() * lump.sum;  // now the rate of the turn
  }
  for (std::size_t n = 0; n < mass_.size(); ++n)
    change[n] = of(n).stands ? Vec3(Vec3::Zero()) : Vec3(of(n).sum.cross(place[n] - of(n).centre));
}

}  // namespace palpate::physics
