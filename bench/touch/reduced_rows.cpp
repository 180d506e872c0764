#include "bench/touch/reduced_rows.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "bench/problems/held_block.h"
#include "bench/problems/stopwatch.h"
#include "physics_node/reduced/driving_point.h"

namespace palpate::bench {
namespace {

constexpr double shift = 100;                           // [1/s^2]
constexpr double beta = 1e-3;                           // viscosity over modulus [s]
constexpr std::array swings = {5.0, 10.0, 20.0, 30.0};  // [Hz]
constexpr int of_truth = 60;

/// Error of the compliance at each swing: as it is told, with what comes to the body's modes as a compliance, and without that.
struct Off {
  std::array<double, swings.size()> told{}, at_once{}, of_body{};
};

Off off(const physics::DrivingPoint& point, Eigen::Index n, const physics::DrivingPoint& truth) {
  physics::DrivingPoint body;
  body.psi = point.psi.leftCols(n);
  body.omega2 = point.omega2.head(n);
  const Eigen::Matrix3cd steady = point.compliance(beta, 0) - body.compliance(beta, 0);
  Off found;
  for (std::size_t f = 0; f < swings.size(); ++f) {
    const double w = 2 * std::numbers::pi * swings[f];
    const Eigen::Matrix3cd exact = truth.compliance(beta, w);
    const auto error = [&](const Eigen::Matrix3cd& told) { return (told - exact).norm() / exact.norm(); };
    found.told[f] = error(point.compliance(beta, w));
    found.at_once[f] = error(body.compliance(beta, w) + steady);
    found.of_body[f] = error(body.compliance(beta, w));
  }
  return found;
}

std::string percent(const std::array<double, swings.size()>& errors) {
  std::string text;
  for (const double error : errors) text += fmt::format("{:5.1f}", 100 * error);
  return text;
}

}  // namespace

nlohmann::json reduced_rows() {
  fmt::print(
      "a block of 60 x 60 x 30 mm, 10 kPa, as a few modes; the compliance under a patch of 5 mm: error in % "
      "at "
      "5, 10, 20, 30 Hz against {} modes; with what comes to them as a compliance; without that\n",
      of_truth);
  nlohmann::json json = nlohmann::json::array();
  for (const double edge : {0.0025, 0.00125}) {
    const physics::Body body =
        held_block({.size = Vec3(0.06, 0.06, 0.03), .edge = edge, .viscosity_time = beta});
    const auto contact = patch_on_top(body, 0.005);
    physics::LinearAnswer answer(body, shift);
    const physics::VibrationModes all =
        physics::lowest_modes(answer, {.n = of_truth, .tolerance = 1e-2, .most_solves = 240});
    const physics::DrivingPoint truth = physics::driving_point(answer, all, contact);
    for (const int n : {0, 3, 9, 20}) {
      const Stopwatch of_modes;
      const physics::VibrationModes modes = physics::lowest_modes(answer, {.n = n});
      const double modes_s = of_modes.cpu_s();
      const Stopwatch of_point;
      const physics::DrivingPoint point = physics::driving_point(answer, modes, contact);
      const double point_s = of_point.cpu_s();
      const Off errors = off(point, modes.omega2.size(), truth);
      fmt::print(
          "  cells of {:.2f} mm ({} nodes)  {:2} modes  {:.2f} s, {} solves{}  a contact {:.0f} ms  {}  |{}  "
          "|{}\n",
          1e3 * edge, body.n_nodes(), n, modes_s, modes.solves, modes.converged ? "" : " (not converged)",
          1e3 * point_s, percent(errors.told), percent(errors.at_once), percent(errors.of_body));
      std::fflush(stdout);
      json.push_back({{"edge_m", edge},
                      {"nodes", body.n_nodes()},
                      {"modes", n},
                      {"solves", modes.solves},
                      {"converged", modes.converged},
                      {"modes_cpu_s", modes_s},
                      {"contact_cpu_s", point_s},
                      {"swings_Hz", swings},
                      {"error", errors.told},
                      {"error_residual_at_once", errors.at_once},
                      {"error_of_body_modes", errors.of_body}});
    }
  }
  return json;
}

}  // namespace palpate::bench
