// kernel_steps ELEMENTS PRECISION WORK STEPS: sets up a cube of tissue, moves it so many steps in one thread and prints its
// number of masses. What two runs of K and 2 K steps differ by is the work of K steps. ELEMENTS are springs on a lattice, fcc or
// voxel, or hexahedra.

#include <cstdio>
#include <cstdlib>
#include <string>

#include "bench/problems/cube.h"
#include "bench/problems/hex_cube.h"

namespace palpate {
namespace {

int print_masses(const physics::BodyModel& body) {
  std::printf("%d\n", body.body().lattice.n_masses());
  return body.is_finite() ? 0 : 1;
}

int step_hexahedra(Precision precision, const std::string& work, int steps) {
  bench::HexCubeKind kind;
  kind.precision = precision;
  kind.hourglass = work == "isotropic" ? HourglassKind::isotropic : HourglassKind::physical;
  kind.damped = work == "damped";
  kind.relaxing = work == "relaxing";
  kind.breaking = work == "breaking";
  kind.yielding = work == "plastic";
  kind.yielded = work == "yielding";
  kind.cells = 19;
  bench::HexCube cube = bench::make_hex_cube(kind);
  cube.step(steps, nullptr, 1);
  return print_masses(*cube.body);
}

int step_springs(LatticeKind lattice, Precision precision, const std::string& wanted, int steps) {
  bench::CubeKind kind;
  kind.lattice = lattice;
  kind.precision = precision;
  for (const auto work :
       {bench::Work::undamped, bench::Work::damped, bench::Work::plastic, bench::Work::yielding})
    if (bench::name_of(work) == wanted) kind.work = work;
  kind.masses = 8000;
  bench::Cube cube = bench::make_cube(kind);
  bench::set_moving(kind, cube, 1);
  for (int n = 0; n < steps; ++n) bench::step(cube, 1);
  return print_masses(*cube.body);
}

}  // namespace
}  // namespace palpate

int main(int argc, char** argv) {
  using namespace palpate;
  if (argc != 5) return 2;
  const std::string elements = argv[1], work = argv[3];
  const Precision precision = std::string(argv[2]) == "single" ? Precision::single_ : Precision::double_;
  const int steps = std::atoi(argv[4]);
  if (elements == "hexahedra") return step_hexahedra(precision, work, steps);
  return step_springs(elements == "fcc" ? LatticeKind::fcc : LatticeKind::voxel, precision, work, steps);
}
