// Torque from tissue to hand through the real programs: a stick held at one end and pressed onto a slab turns up by what the
// hand's torsional spring gives, is limited, and is in the flight, the summary and nowhere but in contact.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "common/report/json_file.h"
#include "tests/system/hand_session.h"

namespace palpate::test {
namespace {

constexpr double torque_limit = 0.02;        // of the device [N m]
constexpr double hand_turns = 0.2;           // stiffness of the hand against turning [N m/rad]
constexpr double near = 0.018, far = 0.082;  // where the slab lies along the stick, from the hand [m]

using Row = std::map<std::string, double>;  // a line of a flight by column; without the state

std::vector<Row> read_flight(const std::string& path) {
  std::ifstream file(path);
  std::string line, word;
  std::vector<std::string> names;
  std::getline(file, line);
  for (std::istringstream head(line); std::getline(head, word, ',');) names.push_back(word);
  std::vector<Row> rows;
  while (std::getline(file, line)) {
    Row row;
    std::istringstream words(line);
    for (const std::string& name : names) {
      std::getline(words, word, ',');
      if (name != "state") row[name] = std::stod(word);
    }
    rows.push_back(row);
  }
  return rows;
}

double norm(const Row& row, const char* x, const char* y, const char* z) {
  return std::hypot(row.at(x), row.at(y), row.at(z));
}
double force_of(const Row& row) { return norm(row, "fx_N", "fy_N", "fz_N"); }
double torque_of(const Row& row) { return norm(row, "mx_Nm", "my_Nm", "mz_Nm"); }

/// Means of the rows between two times.
Row mean(const std::vector<Row>& rows, double from, double to) {
  Row sum;
  double n = 0;
  for (const Row& row : rows) {
    if (row.at("t_s") < from || row.at("t_s") >= to) continue;
    for (const auto& [name, value] : row) sum[name] += value;
    n += 1;
  }
  for (auto& [name, value] : sum) value /= n;
  return sum;
}

/// The slab of scenes/stick.toml in coarser cells. The stick lies along +x from the hand, which is beside the slab.
class HandTorque : public HandSession {
 protected:
  std::string scene() const override {
    return R"(title = "A stick held at its end, pressed onto a slab"
gravity_m_per_s2 = [0, 0, 0]
[physics]
frame_Hz = 250
[[body]]
name = "tissue"
lattice = "voxel"
spacing_mm = 8.0
shape = "box"
size_mm = [64, 80, 24]
at_mm = [0, 0, -12]
fixed = ["-z"]
material = "soft"
[material.soft]
density_kg_per_m3 = 1000
modulus_kPa = 60
viscosity_Pa_s = 10
[[tool]]
name = "stick"
shape = "stick"
force_model = "tangent"
length_mm = 100
radius_mm = 8
theta_deg = [0, -90, 0]
device = "hand"
stiffness_N_per_m = 400
[device.hand]
driver = "simulated"
hand = "arm"
max_torque_N_m = 0.02
turn_stiffness_N_m_per_rad = 0.2
waypoints = [[0, -50, 0, 18], [0.8, -50, 0, 14], [1.6, -50, 0, 4], [3.6, -50, 0, 4], [4.2, -50, 0, -10],
             [5.7, -50, 0, -10], [6.3, -50, 0, 24]]
)";
  }

  /// The whole movement, then an emergency stop, of which the last ten seconds are left.
  std::vector<Row> press() {
    device->estop = 0;
    std::filesystem::remove(folder / "log");
    const std::uint64_t before = device->writes;
    start_both();
    EXPECT_TRUE(until([&] { return device->writes > before && force_now() > 0.05; })) << log();
    EXPECT_TRUE(until([this] { return device->at(device->writes - 1).z > 0.0239; })) << log();
    device->estop = 1;
    EXPECT_TRUE(until([this] { return log().find("flight_stick.csv") != std::string::npos; })) << log();
    end(haptic, SIGTERM);
    end(physics, SIGTERM);
    return read_flight(folder / "out" / "flight_stick.csv");
  }
  /// A machine that stalls the loop or physics makes the hand let go in between: then nothing is to be learnt.
  std::vector<Row> press_undisturbed() {
    for (int attempt = 1;; ++attempt) {
      auto flight = press();
      const auto summary = haptic_summary();
      if (attempt == 5 || summary["stale_events"].get<int>() + summary["safe_events"].get<int>() == 0)
        return flight;
    }
  }
  nlohmann::json haptic_summary() const {
    return read_json((folder / "out" / "parts" / "haptic.json").string())["haptic"];
  }
};

TEST_F(HandTorque, TurnsAHandThatPressesAStickBesideItsMiddle) {
  const auto flight = press_undisturbed();
  ASSERT_GT(flight.size(), 6000u);
  // The path begins when forces are on.
  double begin = 0;
  for (const Row& row : flight)
    if (row.at("z_m") > 0.018 - 1e-6 && row.at("t_s") < flight.front().at("t_s") + 5) begin = row.at("t_s");

  // 1. Held below the limit: the torque about the tip is that of a force upward under the slab's part of the stick, and the
  // hand's spring has turned by as much, the far end up.
  const Row held = mean(flight, begin + 3.2, begin + 3.6);
  const double M = held.at("my_Nm"), F = held.at("fz_N"), turn = 2 * std::asin(held.at("qy"));
  EXPECT_GT(F, 0.1);
  EXPECT_LT(M, -F * near);
  EXPECT_GT(M, -F * far);
  EXPECT_GT(-M, 0.1 * torque_limit);
  EXPECT_LT(-M, 0.9 * torque_limit);
  EXPECT_NEAR(turn, M / hand_turns, 0.05 * std::abs(M) / hand_turns);
  EXPECT_LT(std::abs(held.at("mx_Nm")), 0.1 * -M);

  // 2. Pressed further: limited, in what is computed and in what the device is told.
  double most = 0, told = 0;
  for (const Row& row : flight) most = std::max(most, torque_of(row));
  for (std::uint64_t n = 0; n < device->writes; ++n) told = std::max(told, device->at(n).torque);
  EXPECT_NEAR(most, torque_limit, 1e-6);
  EXPECT_LE(told, torque_limit * (1 + 1e-9));
  EXPECT_NEAR(told, torque_limit, 1e-6);

  // 3. None outside, before it touches and after it has left.
  std::size_t outside = 0;
  for (const Row& row : flight) {
    if (row.at("z_m") < 0.012) continue;
    ++outside;
    ASSERT_EQ(torque_of(row), 0) << row.at("t_s");
    ASSERT_EQ(force_of(row), 0) << row.at("t_s");
  }
  EXPECT_GT(outside, 1000u);
  EXPECT_GT(flight.back().at("z_m"), 0.012);

  // 4. In the summary.
  EXPECT_NEAR(haptic_summary()["torque_max_N_m"].get<double>(), most, 1e-6);
  EXPECT_GT(haptic_summary()["force_max_N"].get<double>(), F);
  EXPECT_EQ(haptic_summary()["force_models"]["stick"], "tangent");
}

}  // namespace
}  // namespace palpate::test
