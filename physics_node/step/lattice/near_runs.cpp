#include "physics_node/step/lattice/near_runs.h"

#include <cstdint>
#include <numbers>

namespace palpate::physics {
namespace {

constexpr double step_of_radius = 1.1;
constexpr double slightly_bent = 0.05;  // Why: skin of a ball of 80 mm misses so much of half a ball of 20 mm
constexpr double most_of_least = 3;

/// Whose middles lie in a ball.
std::int64_t cells_within(const Body& body, const HexGrid& grid, const Vec3& place, double within) noexcept {
  const Vec3 to_middle = 0.5 * body.lattice.step - place;
  std::int64_t n = 0;
  each_run_about(body.lattice, grid, place, within, [&](std::size_t r) {
    const HexRun& run = grid.runs[r];
    for (Index i = run.first; i < run.first + run.count; ++i)
      if (body.solid->stiffness[static_cast<std::size_t>(i)] > 0 &&
          (body.rest_position(i) + to_middle).squaredNorm() < within * within)
        ++n;
  });
  return n;
}

}  // namespace

bool comes_within(const Body& body, const HexRun& run, const Vec3& place, double within) noexcept {
  const Vec3 low = body.rest_position(run.first);
  const Vec3 high = body.rest_position(run.first + run.count - 1) + body.lattice.step;
  return (place.cwiseMax(low).cwiseMin(high) - place).squaredNorm() < within * within;
}

double reach_of(const Body& body, const HexGrid& grid, const Vec3& place, double least) noexcept {
  const double half_ball = 2 * std::numbers::pi / 3 * least * least * least;
  const double cells_of_half = half_ball / body.lattice.step.prod();
  const auto cells = [&](double r) { return static_cast<double>(cells_within(body, grid, place, r)); };
  const double missing = 1 - cells(least) / cells_of_half;
  const double most_cells = cells_of_half * (1 + std::clamp(4 * (missing - slightly_bent), 0.0, 1.0));
  double reach = least;
  for (double r = least * step_of_radius; r <= least * most_of_least; r *= step_of_radius) {
    if (cells(r) > most_cells) break;
    reach = r;
  }
  return reach;
}

}  // namespace palpate::physics
