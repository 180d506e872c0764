#include "physics_node/record/recorder.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/image/scratch_folder.h"
#include "tests/support/physics/pressed_world.h"

namespace palpate::physics {
namespace {

using namespace test;
using palpate::test::ScratchFolder;

constexpr int n_frames = 100;

/// Presses a slab for a tenth of a second and leaves the files behind.
class Recording : public testing::Test {
 protected:
  void SetUp() override {
    Recipe recipe = pressed_slab_recipe();
    recipe.world += "[record]\nwhat = [\"positions\", \"forces\", \"energy\"]\nrate_Hz = 50\n";
    World world(scene_of(recipe));
    Recorder recorder(world, SceneSource{}, folder_.path(), Recorder::WhenBehind::wait);
    for (int n = 0; n < n_frames; ++n) {
      const auto hand = steady_hand({0, 0, 1.5});
      run(world, hand, 1);
      recorder.frame(world, std::span(&hand, 1));
    }
    recorder.finish(world);
    n_masses_ = static_cast<std::uint64_t>(world.body(0).body().lattice.n_masses());
    top_ = world.body(0).body().lattice.masses.back();
    last_force_ = world.tool(0).force();
    last_energy_ = world.ledger();
    last_dissipated_ = world.watched_ledger().dissipated;
    EXPECT_EQ(recorder.dropped(), 0u);
    EXPECT_NEAR(recorder.force_peak(0), last_force_.norm(), 1e-12);
  }
  ScratchFolder folder_;
  std::uint64_t n_masses_ = 0;
  Index top_ = 0;
  Vec3 last_force_;
  EnergyLedger last_energy_;
  double last_dissipated_ = 0;
};

std::vector<std::string> lines_of(const std::string& path) {
  std::ifstream in(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST_F(Recording, LeavesOneRowPerFrame) {
  const auto lines = lines_of(folder_ / Recorder::trace_name("tip"));
  ASSERT_EQ(lines.size(), 1u + n_frames);
  EXPECT_EQ(lines[0],
            "t_s,x_m,y_m,z_m,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,contacts,"
            "raw_fx_N,raw_fy_N,raw_fz_N,raw_mx_Nm,raw_my_Nm,raw_mz_Nm");
  EXPECT_EQ(lines[1].substr(0, 9), "0.001000,");
  double t = 0, x = 0, y = 0, z = 0, fx = 0, fy = 0, fz = 0;
  ASSERT_EQ(std::sscanf(lines.back().c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf", &t, &x, &y, &z, &fx, &fy, &fz),
            7);
  EXPECT_NEAR(t, 0.1, 1e-9);
  EXPECT_NEAR(z, slab_top - 0.002, 1e-9);
  EXPECT_NEAR(fz, last_force_.z(), 1e-8);
}

TEST_F(Recording, TellsWhereTheEnergyIsAtTheSameRate) {
  const auto lines = lines_of(folder_ / "energy.csv");
  ASSERT_EQ(lines.size(), 1u + 6u);
  EXPECT_EQ(lines[0],
            "t_s,kinetic_J,elastic_J,gravitational_J,dissipated_J,plastic_J,numerical_J,broken_J,guard_J,"
            "tool_work_J,contact_J,cut_J");
  double t = 0, kinetic = 0, elastic = 0, gravitational = 0, dissipated = 0;
  ASSERT_EQ(std::sscanf(lines.back().c_str(), "%lf,%lf,%lf,%lf,%lf", &t, &kinetic, &elastic, &gravitational,
                        &dissipated),
            5);
  EXPECT_NEAR(t, 0.1, 1e-9);
  // Before the push of the tool in that step.
  EXPECT_NEAR(kinetic, last_energy_.kinetic, 0.5 * last_energy_.kinetic);
  // Of the step before.
  EXPECT_NEAR(elastic, last_energy_.elastic, 0.1 * last_energy_.elastic);
  EXPECT_NEAR(dissipated, last_dissipated_, 1e-6 * last_dissipated_);
  EXPECT_LT(dissipated, last_energy_.dissipated) << "which has the last step as well";
}

TEST_F(Recording, KeepsPositionsAtTheRateAskedFor) {
  const Hdf5File file(folder_ / "record.h5", Hdf5File::Mode::read);
  const auto times = file.read<double>("/bodies/body/time");
  ASSERT_EQ(times.size(), 6u);  // the first frame, then every 20 ms
  EXPECT_NEAR(times[0], 0.001, 1e-12);
  EXPECT_NEAR(times[5], 0.1, 1e-9);
  EXPECT_EQ(file.shape("/bodies/body/position"), (std::vector<std::uint64_t>{6, n_masses_, 3}));
  EXPECT_EQ(file.shape("/bodies/body/rest"), (std::vector<std::uint64_t>{n_masses_, 3}));
  EXPECT_EQ(file.shape("/tools/tip/t_p_force_moment"), (std::vector<std::uint64_t>{n_frames, 10}));
  const auto positions = file.read<float>("/bodies/body/position");
  const auto rest = file.read<float>("/bodies/body/rest");
  float lowest = 0;
  for (std::size_t n = 0; n < rest.size(); n += 3)
    lowest = std::min(lowest, positions[5 * rest.size() + n + 2] - rest[n + 2]);
  EXPECT_LT(lowest, -0.0005F);
  for (const auto corner : file.read<std::uint32_t>("/bodies/body/facets")) ASSERT_LT(corner, n_masses_);
}

TEST(Recorder, KeepsTheEndOfARunThatEndsBetweenTwoSnapshots) {
  for (const auto when_behind : {Recorder::WhenBehind::wait, Recorder::WhenBehind::drop}) {
    const ScratchFolder folder;
    Recipe recipe = pressed_slab_recipe();
    recipe.world += "[record]\nwhat = [\"positions\"]\nrate_Hz = 50\n";
    World world(scene_of(recipe));
    Recorder recorder(world, SceneSource{}, folder.path(), when_behind);
    for (int n = 0; n < 27; ++n) {
      const auto hand = steady_hand({0, 0, 1.5});
      run(world, hand, 1);
      recorder.frame(world, std::span(&hand, 1));
    }
    recorder.finish(world);
    const Hdf5File file(folder / "record.h5", Hdf5File::Mode::read);
    const auto times = file.read<double>("/bodies/body/time");
    ASSERT_EQ(times.size(), 3u);
    EXPECT_NEAR(times[1], 0.02, 1e-9);
    EXPECT_NEAR(times[2], world.t(), 1e-12);
    const auto positions = file.read<float>("/bodies/body/position");
    const auto& body = world.body(0);
    const Index top = body.body().lattice.masses.back();
    EXPECT_EQ(positions.back(), static_cast<float>(body.position(top).z())) << "where it is then";
  }
}

TEST(Recorder, SaysWhereItCannotWrite) {
  const World world(pressed_slab());
  EXPECT_THROW(Recorder(world, SceneSource{}, "/nowhere/at/all", Recorder::WhenBehind::drop),
               std::runtime_error);
}

}  // namespace
}  // namespace palpate::physics
