#include "bench/peers/lammps_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "common/file/scratch_folder.h"

namespace palpate::bench {
namespace {

using testing::HasSubstr;

TEST(LammpsFiles, TheLogGivesVersionAndCpuTimeOfAllRanks) {
  const ScratchFolder scratch;
  const auto file = scratch.path() / "log";
  std::ofstream(file)
      << "LAMMPS (29 Sep 2021 - Update 2)\nLoop time of 0.5 on 2 procs for 400 steps with 9842 atoms\n\n"
         "80.0% CPU use with 2 MPI tasks x 1 OpenMP threads\n";
  const LammpsLog log = read_lammps_log(file);
  EXPECT_TRUE(log.finished);
  EXPECT_EQ(log.version, "29 Sep 2021 - Update 2");
  EXPECT_DOUBLE_EQ(log.wall_s, 0.5);
  EXPECT_DOUBLE_EQ(log.cpu_s, 0.8);
}

TEST(LammpsFiles, ALogThatStopsIsNotFinished) {
  const ScratchFolder scratch;
  const auto file = scratch.path() / "log";
  std::ofstream(file) << "LAMMPS (29 Sep 2021)\nERROR: Bond atoms 1 2 missing on proc 0 at step 7\n";
  EXPECT_FALSE(read_lammps_log(file).finished);
  EXPECT_FALSE(read_lammps_log(scratch.path() / "none").finished);
}

TEST(LammpsFiles, ADumpThatLacksAMassIsNotRead) {
  const ScratchFolder scratch;
  const auto file = scratch.path() / "dump";
  SpringBody body;
  body.rest = {{0, 0, 0}, {1, 0, 0}};
  std::ofstream(file) << "ITEM: TIMESTEP\n4\nITEM: ATOMS id x y z\n1 0 0 -0.5\n2 1.25 0 0\n";
  const auto displacement = read_lammps_dump(file, body);
  ASSERT_EQ(displacement.size(), 2U);
  EXPECT_EQ(displacement[0], Vec3(0, 0, -0.5));
  EXPECT_EQ(displacement[1], Vec3(0.25, 0, 0));
  body.rest.emplace_back(2, 0, 0);
  EXPECT_TRUE(read_lammps_dump(file, body).empty());
}

TEST(LammpsFiles, TheBondHasHalfTheSpringConstant) {
  const Drop drop = make_drop(100);
  const Task task{&drop, 10, 4, false};
  const double half = 0.5 * drop.body.springs.front().k;
  EXPECT_THAT(lammps_script(task), HasSubstr("bond_coeff 1 " + std::to_string(half).substr(0, 5)));
  EXPECT_THAT(lammps_script(task), HasSubstr("run 40\n"));
  EXPECT_THAT(lammps_script(task), HasSubstr("timestep 0.00025"));
}

}  // namespace
}  // namespace palpate::bench
