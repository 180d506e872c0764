// palpate new: from a volume of any kind to a scene that touches tissue at the first try, as deep as it says.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/record/volume.h"
#include "common/report/json_file.h"
#include "common/scene/body_spec.h"
#include "common/scene/device_spec.h"
#include "common/scene/load_scene.h"
#include "tests/support/image/made_scans.h"
#include "tests/system/command_run.h"
#include "tests/system/shell.h"

namespace palpate {
namespace {

using test::MadeScan;
using testing::HasSubstr;

constexpr const char* head = "/usr/share/doc/invesalius-examples/examples/Cranium.inv3";

struct Sample {
  double t = 0, force = 0;
  Vec3 tip = Vec3::Zero();
};

/// The path that palpate new has written, taken apart.
struct Press {
  explicit Press(const Scene& scene) {
    const auto& path = scene.devices[0].waypoints;
    surface = path[1].p;
    touches_at = path[1].t;
    outward = (path[0].p - surface).normalized();
    depth = (surface - path[2].p).dot(outward);
  }
  Vec3 surface, outward;
  double touches_at = 0, depth = 0;
};

class New : public CommandRun {
 protected:
  std::string in(const std::string& name) const { return test::quoted(folder / name); }
  int new_scene(const std::string& more = "") {
    return palpate("new " + in("v.h5") + " --out " + in("s.toml") + " " + more);
  }
  Scene scene() const { return load_scene((folder / "s.toml").string()); }

  std::vector<Sample> trace() const {
    std::ifstream file(folder / "out" / "tool_finger.csv");
    std::vector<Sample> samples;
    std::string line;
    while (std::getline(file, line)) {
      Sample sample;
      Vec3 f;
      if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf", &sample.t, &sample.tip.x(),
                      &sample.tip.y(), &sample.tip.z(), &f.x(), &f.y(), &f.z()) != 7)
        continue;
      sample.force = f.norm();
      samples.push_back(sample);
    }
    return samples;
  }

  /// The scene has nothing to be remarked on, says when it touches, touches then, and presses as deep as planned.
  void expect_touch() {
    const Press press(scene());
    ASSERT_EQ(palpate("info " + in("s.toml")), 0) << log;
    EXPECT_THAT(log, Not(HasSubstr("remark")));
    double said = 0;
    const std::size_t touch = log.find("touch        finger meets tissue after ");
    ASSERT_NE(touch, std::string::npos) << log;
    ASSERT_EQ(std::sscanf(log.c_str() + touch, "touch        finger meets tissue after %lf", &said), 1);
    EXPECT_NEAR(said, press.touches_at, 0.02);

    ASSERT_EQ(palpate("simulate " + in("s.toml") + " --no-frames --out " + in("out")), 0) << log;
    double deepest = 0, first = HUGE_VAL, most = 0;
    for (const Sample& sample : trace()) {
      deepest = std::max(deepest, (press.surface - sample.tip).dot(press.outward));
      most = std::max(most, sample.force);
      if (sample.force > 0) first = std::min(first, sample.t);
    }
    EXPECT_NEAR(deepest, press.depth, 0.02 * press.depth);
    EXPECT_GT(most, 0);
    // A corner of a cell may be met before a sample of a face is: within a third of the way in, which takes a second.
    EXPECT_GT(first, said - 0.05);
    EXPECT_LT(first, said + 0.34);
    const auto summary = read_json((folder / "out" / "summary.json").string());
    EXPECT_GT(summary["tools"]["finger"]["contacts_max"].get<int>(), 0);
    EXPECT_EQ(summary["guard"]["nonfinite"].get<int>(), 0);
  }

  void expect_mistake(const std::string& more, const std::string& what) {
    EXPECT_EQ(new_scene(more), 2) << log;
    EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 1) << log;
    EXPECT_THAT(log, HasSubstr(what));
    EXPECT_FALSE(std::filesystem::exists(folder / "s.toml"));
    EXPECT_FALSE(std::filesystem::exists(folder / "s.toml.part"));
  }
};

class NewOfScans : public New, public testing::WithParamInterface<MadeScan (*)()> {};

TEST_P(NewOfScans, TouchTissueAtTheFirstTry) {
  const MadeScan scan = GetParam()();
  write_volume(scan.volume, (folder / "v.h5").string());
  ASSERT_EQ(new_scene(), 0) << log;
  const Scene made = scene();
  const Press press(made);
  const auto& partition = *std::get<VolumeShape>(made.bodies[0].shape).partition;
  Vec3 cell;
  for (Eigen::Index a = 0; a < 3; ++a)
    cell[a] = scan.volume.size[static_cast<std::size_t>(a)] * scan.volume.spacing[a] /
              partition[static_cast<std::size_t>(a)];
  EXPECT_NEAR(scan.above_surface(press.surface), 0, cell.norm());
  EXPECT_LT(scan.above_surface(press.surface - press.depth * press.outward), -0.5 * press.depth);
  expect_touch();
}

std::string name_of(const testing::TestParamInfo<MadeScan (*)()>& info) { return info.param().name; }
INSTANTIATE_TEST_SUITE_P(Kinds, NewOfScans,
                         testing::Values(&test::ct_head, &test::mr_with_bias, &test::oblique_left_handed,
                                         &test::tenth_of_a_millimetre, &test::anisotropic,
                                         &test::all_negative),
                         name_of);

TEST_F(New, TouchesARealHead) {
  ASSERT_TRUE(std::filesystem::exists(head)) << "install the Debian package invesalius-examples";
  ASSERT_EQ(palpate(std::string("import ") + head + " --out " + in("v.h5")), 0) << log;
  ASSERT_EQ(new_scene(), 0) << log;
  expect_touch();
}

TEST_F(New, TouchesWhereItIsTold) {
  const MadeScan scan = test::anisotropic();
  write_volume(scan.volume, (folder / "v.h5").string());
  ASSERT_EQ(new_scene("--at -5,-30,4"), 0) << log;
  const Press press(scene());
  const Vec3 asked(-0.005, -0.030, 0.004);
  EXPECT_NEAR(scan.above_surface(press.surface), 0, 3e-3);
  EXPECT_LT((press.surface - asked).norm(), std::abs(scan.above_surface(asked)) + 4e-3);
  expect_touch();
}

TEST_F(New, SaysEachMistakeInALine) {
  write_volume(test::anisotropic().volume, (folder / "v.h5").string());
  expect_mistake("--at 0,0,900", "lies outside of the image");
  expect_mistake("--at 0,0", "--at");
  expect_mistake("--at nan,0,0", "nan");
  expect_mistake("--keep 5,3", "lowest intensity first");
  expect_mistake("--keep 90000,90001", "fewer than");
  expect_mistake("--keep -30000,30000", "no air");
  EXPECT_EQ(palpate("new " + in("v.h5") + " --out " + in("none/s.toml")), 2) << log;
  EXPECT_EQ(palpate("new " + in("none.h5") + " --out " + in("s.toml")), 2) << log;
  EXPECT_EQ(palpate("new " + in("v.h5") + " --out " + in("s.txt")), 2) << log;
  std::ofstream(folder / "s.toml") << "mine";
  EXPECT_EQ(new_scene(), 2);
  EXPECT_THAT(log, HasSubstr("is there already"));
  std::string kept;
  std::ifstream(folder / "s.toml") >> kept;
  EXPECT_EQ(kept, "mine");
}

TEST_F(New, RefusesImagesThatNothingCanTouch) {
  const auto refused = [&](Volume volume, const std::string& what) {
    write_volume(volume, (folder / "v.h5").string());
    expect_mistake("", what);
  };
  refused(test::scan_of({40, 40, 40}, Vec3::Constant(1e-3), [](const Vec3&) { return 7.0; }),
          "air and tissue");
  refused(
      test::scan_of({40, 40, 40}, Vec3::Constant(1e-3), [](const Vec3&) { return test::normal(300, 40); }),
      "air and tissue");
  refused(test::scan_of({40, 40, 40}, Vec3::Constant(1e-3),
                        [](const Vec3& p) { return p.norm() < 0.9e-3 ? 1000.0 : 0.0; }),
          "joined cells");
  refused(test::scan_of({60, 60, 1}, Vec3::Constant(1e-3),
                        [](const Vec3& p) { return p.norm() < 20e-3 ? 1000.0 : 0.0; }),
          "");
}

}  // namespace
}  // namespace palpate
