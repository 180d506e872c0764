// Scenes of all of a head: one pressed at four places, of which only what is near to the finger is computed, and one whose
// cheek is cut open.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "common/math/vec3.h"
#include "common/report/json_file.h"
#include "tests/system/command_run.h"
#include "tests/system/shell.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;

constexpr const char* head = "/usr/share/doc/invesalius-examples/examples/Cranium.inv3";

class HeadAnywhere : public CommandRun {
 protected:
  /// The largest force on the hand between two times, and its direction.
  Vec3 largest_between(double from, double to) const {
    std::ifstream file(folder / "out" / "tool_finger.csv");
    Vec3 largest = Vec3::Zero();
    std::string line;
    while (std::getline(file, line)) {
      double t = 0;
      Vec3 x, f;
      if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf", &t, &x.x(), &x.y(), &x.z(), &f.x(), &f.y(),
                      &f.z()) != 7)
        continue;
      if (t >= from && t < to && f.norm() > largest.norm()) largest = f;
    }
    return largest;
  }
  void simulate(const std::string& scene, const std::string& options = {}) {
    ASSERT_TRUE(fs::exists(head)) << "install the Debian package invesalius-examples";
    fs::create_directories(folder / "data");
    fs::create_directories(folder / "scenes");
    ASSERT_EQ(
        palpate(std::string("import ") + head + " --out " + test::quoted(folder / "data" / "cranium.h5")), 0)
        << log;
    fs::copy_file(fs::path(SCENES) / scene, folder / "scenes" / scene);
    ASSERT_EQ(palpate("simulate " + test::quoted(folder / "scenes" / scene) + options +
                      " --no-frames --out " + test::quoted(folder / "out")),
              0)
        << log;
  }
};

TEST_F(HeadAnywhere, GivesWayAtCheekForeheadEarAndNape) {
  ASSERT_NO_FATAL_FAILURE(simulate("head_anywhere.toml"));
  // Skin pushes outward: the face looks to +y, its right ear to -x.
  const Vec3 cheek = largest_between(0.8, 1.1), forehead = largest_between(2.5, 2.8),
             ear = largest_between(4.5, 4.8), nape = largest_between(6.3, 6.6);
  for (const Vec3& force : {cheek, forehead, ear, nape}) {
    EXPECT_GT(force.norm(), 0.02) << force.transpose();
    EXPECT_LT(force.norm(), 1.0) << force.transpose();
  }
  EXPECT_GT(cheek.y(), 0.8 * cheek.norm());
  EXPECT_GT(forehead.y(), 0.7 * forehead.norm());
  EXPECT_LT(ear.x(), -0.8 * ear.norm());
  EXPECT_LT(nape.y(), -0.7 * nape.norm());
  // On the way from one to the next nothing is felt.
  for (const double t : {1.8, 3.5, 5.4}) EXPECT_LT(largest_between(t, t + 0.1).norm(), 0.01) << t;
  const auto summary = read_json((folder / "out" / "summary.json").string());
  EXPECT_LT(summary["energy"]["balance_error"].get<double>(), 0.01);
  EXPECT_EQ(summary["guard"]["restored"].get<int>(), 0);
  EXPECT_GT(summary["bodies"]["head"]["sleeping_fraction"].get<double>(), 0.97);
  EXPECT_GT(summary["bodies"]["head"]["masses"].get<int>(), 130'000);
}

TEST_F(HeadAnywhere, IsCutOpenAtTheCheek) {
  ASSERT_NO_FATAL_FAILURE(simulate("scalpel_head.toml", " --seconds 2.4"));
  const auto summary = read_json((folder / "out" / "summary.json").string());
  const auto& blade = summary["tools"]["scalpel"];
  const double area = blade["cut_area_mm2"].get<double>();
  EXPECT_GT(area, 150);
  EXPECT_NEAR(summary["energy"]["cut"].get<double>(), 190e-6 * area, 1e-6);
  // 20 mm of edge, of which not all lies in tissue that moves.
  EXPECT_GT(blade["force_peak"].get<double>(), 3.0);
  EXPECT_LT(blade["force_peak"].get<double>(), 1.1 * 190 * 0.020);
  EXPECT_LT(summary["energy"]["balance_error"].get<double>(), 1e-3);
  EXPECT_EQ(summary["guard"]["restored"].get<int>(), 0);
  EXPECT_EQ(summary["bodies"]["head"]["fragments"].get<int>(), 1);
  EXPECT_GT(summary["bodies"]["head"]["min_corner_J"].get<double>(), 0.05);
}

}  // namespace
}  // namespace palpate
