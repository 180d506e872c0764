#include "bench/fem/tet_rows.h"

#include <fmt/format.h>

#include "bench/fem/tet_cost.h"
#include "bench/problems/settings.h"
#include "bench/problems/stopwatch.h"
#include "bench/problems/tet_beam.h"

namespace palpate::bench {
namespace {

const char* word_of(bool nodal_pressure) { return nodal_pressure ? "tets nodal" : "tets plain"; }

}  // namespace

nlohmann::json tet_kernel_rows(int rounds, double roof, Table& table) {
  std::vector<TetCubeKind> kinds;
  for (const bool nodal : {false, true})
    for (const int cells : {19, 24})
      for (const int threads : {1, 2})
        kinds.push_back({.nodal_pressure = nodal, .cells = cells, .threads = threads});
  for (const bool nodal : {false, true}) {
    kinds.push_back({.nodal_pressure = nodal, .damped = true});
    kinds.push_back({.nodal_pressure = nodal, .precision = Precision::double_});
  }
  nlohmann::json json;
  for (const TetCost& cost : measure_tet_costs(kinds, rounds)) {
    const TetCubeKind& kind = cost.kind;
    const double share = cost.flops / (1e-9 * cost.median_ns()) / (roof * kind.threads);
    fmt::print(
        "  {:10} {:8} {:6} {:6.0f} tets {} threads {:6.2f} ns a tet (least {:.2f})  {:4.0f} flops  {:3.0f} % "
        "of the roof  "
        "stable step {:.3f} ms  {:6.0f} tets at 1 kHz\n",
        word_of(kind.nodal_pressure), kind.damped ? "damped" : "undamped", name_of(kind.precision),
        kind.tets(), kind.threads, cost.median_ns(), cost.least_ns(), cost.flops, 100 * share,
        1e3 * cost.stable_step, cost.tets_at_1_kHz());
    table.add({word_of(kind.nodal_pressure), kind.damped ? "damped" : "undamped", name_of(kind.precision),
               std::to_string(kind.cells), std::to_string(kind.threads), text_of(cost.median_ns()),
               text_of(cost.least_ns()), text_of(cost.flops), text_of(cost.bytes), text_of(share),
               text_of(cost.stable_step), text_of(cost.tets_at_1_kHz())});
    json.push_back({{"nodal_pressure", kind.nodal_pressure},
                    {"damped", kind.damped},
                    {"precision", name_of(kind.precision)},
                    {"tets", kind.tets()},
                    {"threads", kind.threads},
                    {"ns_per_tet", cost.median_ns()},
                    {"ns_per_tet_least", cost.least_ns()},
                    {"flops_per_tet", cost.flops},
                    {"bytes_per_tet", cost.bytes},
                    {"share_of_roof", share},
                    {"stable_step_s", cost.stable_step},
                    {"tets_at_1_kHz", cost.tets_at_1_kHz()}});
  }
  return json;
}

nlohmann::json tet_beam_rows() {
  nlohmann::json json;
  for (const bool nodal : {false, true})
    for (const double nu : {0.3, 0.45, 0.49})
      for (const int cells : {2, 4}) {
        const Stopwatch watch;
        const double ratio = tet_beam_ratio({.cells = cells, .poisson_ratio = nu, .nodal_pressure = nodal});
        fmt::print("  {:10} nu {:.2f} {} cells thick, 6 tets each {:.4f}\n", word_of(nodal), nu, cells,
                   ratio);
        json.push_back({{"elements", word_of(nodal)},
                        {"poisson_ratio", nu},
                        {"cells", cells},
                        {"ratio", ratio},
                        {"cpu_s", watch.cpu_s()}});
      }
  return json;
}

}  // namespace palpate::bench
