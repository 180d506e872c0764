#pragma once
// What LAMMPS reads and writes: a data file of the body, an input script per run, its log and the positions it dumps.

#include <filesystem>
#include <string>

#include "bench/peers/solver.h"

namespace palpate::bench {

/// Masses as atoms of two types (1 moves, 2 is held), springs as bonds. @throws std::runtime_error
void write_lammps_data(const std::filesystem::path& file, const SpringBody& body);

/// Velocity Verlet under gravity with harmonic bonds; lists are built once, for bonds never change.
std::string lammps_script(const Task& task);

struct LammpsLog {
  std::string version;  // of the first line
  bool finished = false;
  double wall_s = 0;  // "Loop time"
  double cpu_s = 0;   // wall_s x CPU use x ranks
};
LammpsLog read_lammps_log(const std::filesystem::path& file);

/// Displacements in the order of the masses; empty where the dump is not whole.
std::vector<Vec3> read_lammps_dump(const std::filesystem::path& file, const SpringBody& body);

}  // namespace palpate::bench
