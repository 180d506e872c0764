#include "bench/skips/measure_skip.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>

#include "bench/problems/stopwatch.h"
#include "physics_node/world.h"

namespace palpate::bench {
namespace {

double resident_MB() {
  std::ifstream file("/proc/self/statm");
  double pages = 0, resident = 0;
  file >> pages >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

void shake(physics::World& world) {
  std::mt19937_64 engine(1);
  const auto dice = [&engine] { return static_cast<double>(engine() >> 11) * 0x1p-52 - 1; };
  for (std::size_t b = 0; b < world.n_bodies(); ++b)
    for (const physics::Index cell : world.body(b).body().lattice.masses)
      world.body(b).place(cell, Vec3::Zero(), 0.01 * Vec3(dice(), dice(), dice()));
  world.restart_ledger();
}

SceneCost run(const Scene& scene, int frames, bool shaken) {
  SceneCost cost;
  const double memory = resident_MB();
  const Stopwatch load;
  physics::World world(scene);
  cost.load_s = load.cpu_s();
  for (std::size_t b = 0; b < world.n_bodies(); ++b) {
    const physics::Body& body = world.body(b).body();
    cost.masses += body.lattice.n_masses();
    cost.moving += body.lattice.n_masses() - body.n_held;
  }
  if (shaken) shake(world);
  for (int n = 0; n < frames / 10; ++n) world.frame({});
  const Stopwatch watch;
  for (int n = 0; n < frames; ++n) world.frame({});
  cost.us_per_frame = 1e6 * watch.cpu_s() / frames;
  cost.asleep = world.body(0).sleeping_fraction();
  cost.load_MB = resident_MB() - memory;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  cost.peak_MB = 1.024e-3 * static_cast<double>(usage.ru_maxrss);
  return cost;
}

}  // namespace

SceneCost measure_scene(const Scene& scene, int frames, bool shaken) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe can be had");
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process can be made");
  if (child == 0) {
    try {
      const SceneCost cost = run(scene, frames, shaken);
      _exit(write(ends[1], &cost, sizeof cost) == static_cast<ssize_t>(sizeof cost) ? 0 : 1);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "palpate bench: %s\n", error.what());
      _exit(1);
    }
  }
  close(ends[1]);
  SceneCost cost;
  const bool whole = read(ends[0], &cost, sizeof cost) == static_cast<ssize_t>(sizeof cost);
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!whole || status != 0) throw std::runtime_error("a scene could not be measured");
  return cost;
}

}  // namespace palpate::bench
