#include "bench/fem/error_rows.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "bench/problems/hex_beam.h"
#include "bench/solids/calculix.h"
#include "bench/solids/resting_beam.h"
#include "bench/solids/sphere_press.h"

namespace palpate::bench {
namespace {

nlohmann::json row(const std::string& problem, const std::string& who, double edge, double error,
                   double cpu_s, bool monotone = true) {
  fmt::print("  {:<11} {:<20} cells of {:>5.2f} mm  error {:+8.2f} %  {:>8.3g} s{}\n", problem, who,
             1e3 * edge, 100 * error, cpu_s, monotone ? "" : "  its force falls on the way");
  return {{"problem", problem}, {"who", who}, {"edge_m", edge}, {"error", error}, {"cpu_s", cpu_s}};
}

BrickAnswer beam_of_bricks(Brick kind, int cells, double poisson_ratio) {
  return solve({.kind = kind,
                .bricks = {8 * cells, cells, cells},
                .place =
                    [](const Vec3& s) {
                      return Vec3(HexBeam::length * s.x(), HexBeam::height * s.y(), HexBeam::height * s.z());
                    },
                .modulus = HexBeam::modulus,
                .poisson_ratio = poisson_ratio,
                .density = HexBeam::density,
                .gravity = HexBeam::gravity});
}

void beam_rows(nlohmann::json& json) {
  constexpr double nu = 0.45;
  const double truth = HexBeam({.cells = 2, .poisson_ratio = nu}).calculix() / HexBeam::gravity;
  const auto add = [&](const std::string& who, const RestingBeam& beam, double sunk) {
    json.push_back(row("cantilever", who, HexBeam::height / beam.cells, beam.sunk / sunk - 1, beam.cpu_s));
  };
  for (const int cells : {1, 2, 4, 8}) {
    add("physical", rest_beam(ElementModel::fem, HourglassKind::physical, cells, nu), truth);
    add("isotropic", rest_beam(ElementModel::fem, HourglassKind::isotropic, cells, nu), truth);
  }
  if (calculix().empty()) {
    fmt::print("  CalculiX: not found (apt-get install calculix-ccx)\n");
    return;
  }
  constexpr double nu_of_springs = 0.25;
  const double truth_of_springs =
      -beam_of_bricks(Brick::quadratic, 4, nu_of_springs).mean().z() / HexBeam::gravity;
  for (const int cells : {2, 4, 8})
    add("springs", rest_beam(ElementModel::springs, HourglassKind::physical, cells, nu), truth_of_springs);
  for (const int cells : {1, 2, 4, 8})
    for (const Brick kind : {Brick::quadratic, Brick::incompatible}) {
      if (kind == Brick::quadratic ? cells > 2 : cells < 2) continue;  // 4 are the reference
      const BrickAnswer answer = beam_of_bricks(kind, cells, nu);
      json.push_back(row("cantilever", kind == Brick::quadratic ? "CalculiX C3D20R" : "CalculiX C3D8I",
                         HexBeam::height / cells, -answer.mean().z() / HexBeam::gravity / truth - 1,
                         answer.cpu_s));
    }
}

void sphere_rows(nlohmann::json& json) {
  constexpr double finest = 0.3756;  // of the physical ones on cells of 1.25 mm [N]
  const auto add = [&](const std::string& who, const SpherePress& how) {
    const Pressed pressed = press(how);
    json.push_back(row("sphere", who, how.edge, pressed.force.back() / finest - 1, pressed.cpu_s,
                       pressed.is_monotone()));
  };
  for (const double edge : {0.005, 0.0025}) {
    add("physical", {.edge = edge});
    add("isotropic", {.edge = edge, .hourglass = HourglassKind::isotropic});
    add("springs", {.edge = edge, .model = ElementModel::springs});
  }
}

}  // namespace

nlohmann::json error_rows() {
  fmt::print(
      "error against CPU time until at rest, one thread: tip of the cantilever over CalculiX, force of a "
      "sphere of 5 mm pressed "
      "5 mm over cells of 1.25 mm\n");
  nlohmann::json json = nlohmann::json::array();
  beam_rows(json);
  sphere_rows(json);
  return json;
}

}  // namespace palpate::bench
