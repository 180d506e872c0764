#include "bench/peers/beam_peers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "bench/peers/equal_error.h"
#include "bench/problems/hex_beam.h"
#include "bench/solids/calculix.h"

namespace palpate::bench {
namespace {

constexpr double nu = 0.45;

struct Row {
  std::string who;
  int cells = 0;
  std::int64_t elements = 0, steps = 0;
  double error = 0, cpu_s = 0;
  bool at_rest = true;
};

Row row_of(const std::string& who, const RestingBeam& beam) {
  const double truth = HexBeam({.cells = 2, .poisson_ratio = nu}).calculix() / HexBeam::gravity;
  return {who, beam.cells, beam.elements, beam.steps, beam.sunk / truth - 1, beam.cpu_s, beam.at_rest};
}

Row row_of_bricks(Brick kind, int cells) {
  const BrickAnswer answer =
      solve({.kind = kind,
             .bricks = {8 * cells, cells, cells},
             .place =
                 [](const Vec3& s) {
                   return Vec3(HexBeam::length * s.x(), HexBeam::height * s.y(), HexBeam::height * s.z());
                 },
             .modulus = HexBeam::modulus,
             .poisson_ratio = nu,
             .density = HexBeam::density,
             .gravity = HexBeam::gravity});
  const double truth = HexBeam({.cells = 2, .poisson_ratio = nu}).calculix();
  return {kind == Brick::quadratic ? "CalculiX C3D20R, static" : "CalculiX C3D8I, static",
          cells,
          8LL * cells * cells * cells,
          0,
          -answer.mean().z() / truth - 1,
          answer.cpu_s};
}

std::vector<TimeOfError> runs_of(const std::vector<Row>& rows, const std::string& who) {
  std::vector<TimeOfError> runs;
  for (const Row& row : rows)
    if (row.who == who) runs.push_back({std::abs(row.error), row.cpu_s});
  return best_runs(runs);
}

/// What each run of another takes, over what palpate's physical hexahedra take to be as exact.
nlohmann::json print_ratios(const std::vector<Row>& rows, const std::string& ours) {
  nlohmann::json json = nlohmann::json::array();
  const std::vector<TimeOfError> best = runs_of(rows, ours);
  fmt::print("  CPU time at equal error, over that of {}:\n", ours);
  for (const Row& row : rows) {
    if (row.who == ours) continue;
    const auto seconds = seconds_for(best, std::abs(row.error));
    if (!seconds) continue;
    fmt::print("    {:<34} error {:>7.2f} %  {:>8.3g} s  {:>8.1f} times\n", row.who,
               100 * std::abs(row.error), row.cpu_s, row.cpu_s / *seconds);
    json.push_back({{"who", row.who}, {"error", std::abs(row.error)}, {"ratio", row.cpu_s / *seconds}});
  }
  return json;
}

}  // namespace

nlohmann::json compare_beams(bool quick) {
  const std::vector<int> all = quick ? std::vector<int>{2} : std::vector<int>{1, 2, 4, 8};
  std::vector<Row> rows;
  for (const int cells : all)
    for (const HourglassKind kind : {HourglassKind::physical, HourglassKind::isotropic})
      rows.push_back(row_of(kind == HourglassKind::physical ? "palpate physical" : "palpate isotropic",
                            rest_beam(ElementModel::fem, kind, cells, nu)));
  for (const int cells : all)
    if (const auto beam = cells < 8 ? bullet_beam(cells, nu) : std::nullopt)  // of 8 cells it takes minutes
      rows.push_back(row_of("Bullet, neo-Hookean tetrahedra", *beam));
  if (!calculix().empty())
    for (const int cells : all) {
      if (cells < 8) rows.push_back(row_of_bricks(Brick::quadratic, cells));
      if (cells > 1) rows.push_back(row_of_bricks(Brick::incompatible, cells));
    }
  else
    fmt::print("CalculiX: not found (apt-get install calculix-ccx)\n");

  std::fflush(stdout);
  fmt::print("\nA cantilever of finite elements let go under its weight until it rests, nu {}, one thread\n",
             nu);
  nlohmann::json json;
  for (const Row& row : rows) {
    const double ns =
        row.steps == 0
            ? 0
            : 1e9 * row.cpu_s / (static_cast<double>(row.elements) * static_cast<double>(row.steps));
    fmt::print("  {:<34} {} thick {:>6} elements {:>6} steps {:>8.1f} ns  {:>8.3g} s  tip {:+7.2f} %{}\n",
               row.who, row.cells, row.elements, row.steps, ns, row.cpu_s, 100 * row.error,
               row.at_rest ? "" : ", not yet at rest");
    json["runs"].push_back({{"who", row.who},
                            {"cells", row.cells},
                            {"elements", row.elements},
                            {"steps", row.steps},
                            {"ns_per_element_and_step", ns},
                            {"cpu_s", row.cpu_s},
                            {"error", row.error}});
  }
  json["ratios"] = print_ratios(rows, "palpate physical");
  return json;
}

}  // namespace palpate::bench
