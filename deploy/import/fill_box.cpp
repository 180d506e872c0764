#include "deploy/import/fill_box.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/error/error.h"
#include "common/math/units.h"

namespace palpate {
namespace {

constexpr double most_points = 2e6;  // of the lattice: more tetrahedra than any machine steps
constexpr int most_shifts = 20;
// What is full of thin places has pinches wherever the lattice lies: that is known after a few.
constexpr int enough_shifts = 4;
constexpr std::size_t few_pinches = 4;
constexpr double most_off = 0.1;  // of the volume, from what was to be filled

/// Where the lattice lies in attempt n: points that are spread evenly (Roberts' R3), the first at the place as it is.
Vec3 lattice_shift(int n) {
  constexpr double g = 1.22074408460575947536;  // g^4 = g + 1
  Vec3 shift(n / g, n / (g * g), n / (g * g * g));
  for (double& part : shift) part -= std::floor(part);
  return shift;
}

}  // namespace

void check_points(const StuffingLattice& lattice, const std::string& where) {
  if (points_of(lattice) <= most_points) return;
  const Vec3 size = lattice.high - lattice.low;
  const double mm = mm_from_m(lattice.edge);
  throw InputError(
      fmt::format("{}: tetrahedra of {:g} mm in a box of {:.0f} x {:.0f} x {:.0f} mm are too many; write "
                  "--tetrahedra-mm {:.2g} or more",
                  where, mm, mm_from_m(size.x()), mm_from_m(size.y()), mm_from_m(size.z()),
                  1.05 * mm * std::cbrt(points_of(lattice) / most_points)));
}

void check_filled(double filled, double wanted, double edge, const std::string& what,
                  const std::string& where) {
  if (filled > 0 && std::abs(filled / wanted - 1) <= most_off) return;
  throw InputError(
      fmt::format("{}: tetrahedra of {:g} mm are too coarse for {}: they fill {:.3g} cm3 of its "
                  "{:.3g}; write a smaller "
                  "--tetrahedra-mm",
                  where, mm_from_m(edge), what, 1e6 * filled, 1e6 * wanted));
}

FilledBox fill_box(StuffingLattice lattice,
                   const std::function<physics::TetMesh(const StuffingLattice&)>& stuff,
                   const std::function<physics::TetMesh(const StuffingLattice&, physics::TetMesh)>& settle) {
  FilledBox filled;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  const auto pinched = [&] {
    filled.pinches = pinches_of(filled.mesh, outer_faces(filled.mesh));
    fewest = std::min(fewest, filled.pinches.edges + filled.pinches.nodes);
    return !filled.pinches.none();
  };
  for (int n = 0; n < most_shifts; ++n) {
    if (n == enough_shifts && fewest > few_pinches) break;
    lattice.shift = lattice_shift(n);
    filled.mesh = stuff(lattice);
    if (pinched()) continue;
    filled.mesh = settle(lattice, std::move(filled.mesh));
    if (!filled.mesh.tets.empty() && !pinched()) break;
  }
  return filled;
}

}  // namespace palpate
