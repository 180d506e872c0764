// kernel_steps LATTICE PRECISION WORK STEPS: sets up a cube of tissue, moves it so many steps in one thread and prints its
// number of masses. What two runs of K and 2 K steps differ by is the work of K steps.

#include <cstdio>
#include <cstdlib>
#include <string>

#include "bench/problems/cube.h"

int main(int argc, char** argv) {
  using namespace palpate;
  if (argc != 5) return 2;
  bench::CubeKind kind;
  kind.lattice = std::string(argv[1]) == "fcc" ? LatticeKind::fcc : LatticeKind::voxel;
  kind.precision = std::string(argv[2]) == "single" ? Precision::single_ : Precision::double_;
  for (const auto work :
       {bench::Work::undamped, bench::Work::damped, bench::Work::plastic, bench::Work::yielding})
    if (bench::name_of(work) == std::string(argv[3])) kind.work = work;
  kind.masses = 8000;
  bench::Cube cube = bench::make_cube(kind);
  bench::set_moving(kind, cube, 1);
  const int steps = std::atoi(argv[4]);
  for (int n = 0; n < steps; ++n) bench::step(cube, 1);
  std::printf("%d\n", cube.body->body().lattice.n_masses());
  return cube.body->is_finite() ? 0 : 1;
}
