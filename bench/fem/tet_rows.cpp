#include "bench/fem/tet_rows.h"

#include <fmt/format.h>

#include <array>

#include "bench/fem/tet_cost.h"
#include "bench/problems/settings.h"
#include "bench/problems/stopwatch.h"
#include "bench/problems/tet_beam.h"

namespace palpate::bench {
namespace {

const char* word_of(TetElement element) {
  switch (element) {
    case TetElement::plain:
      return "tets plain";
    case TetElement::nodal:
      return "tets nodal";
    case TetElement::second_order:
      break;
  }
  return "tets second order";
}
constexpr std::array elements = {TetElement::plain, TetElement::nodal, TetElement::second_order};

}  // namespace

nlohmann::json tet_kernel_rows(int rounds, double roof, Table& table) {
  std::vector<TetCubeKind> kinds;
  for (const TetElement element : elements) {
    const bool second = element == TetElement::second_order;
    for (const int cells : {19, 24}) {
      if (cells == 19 && second) continue;
      for (const int threads : {1, 2})
        kinds.push_back({.element = element, .cells = second ? 12 : cells, .threads = threads});
    }
    kinds.push_back({.element = element, .damped = true, .cells = second ? 12 : 19});
    kinds.push_back({.element = element, .precision = Precision::double_, .cells = second ? 12 : 19});
  }
  nlohmann::json json;
  for (const TetCost& cost : measure_tet_costs(kinds, rounds)) {
    const TetCubeKind& kind = cost.kind;
    const double share = cost.flops / (1e-9 * cost.median_ns()) / (roof * kind.threads);
    fmt::print(
        "  {:17} {:8} {:6} {:6.0f} tets {} threads {:6.2f} ns a tet (least {:.2f}), {:.1f} a node  {:4.0f} "
        "flops  {:3.0f} % "
        "of the roof  "
        "stable step {:.3f} ms  {:6.0f} tets at 1 kHz\n",
        word_of(kind.element), kind.damped ? "damped" : "undamped", name_of(kind.precision), kind.tets(),
        kind.threads, cost.median_ns(), cost.least_ns(), cost.median_ns() / cost.nodes_per_tet, cost.flops,
        100 * share, 1e3 * cost.stable_step, cost.tets_at_1_kHz());
    table.add({word_of(kind.element), kind.damped ? "damped" : "undamped", name_of(kind.precision),
               std::to_string(kind.cells), std::to_string(kind.threads), text_of(cost.median_ns()),
               text_of(cost.least_ns()), text_of(cost.flops), text_of(cost.bytes), text_of(share),
               text_of(cost.stable_step), text_of(cost.tets_at_1_kHz())});
    json.push_back({{"elements", word_of(kind.element)},
                    {"damped", kind.damped},
                    {"precision", name_of(kind.precision)},
                    {"tets", kind.tets()},
                    {"threads", kind.threads},
                    {"ns_per_tet", cost.median_ns()},
                    {"ns_per_tet_least", cost.least_ns()},
                    {"nodes_per_tet", cost.nodes_per_tet},
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
  for (const TetElement element : elements)
    for (const double nu : {0.3, 0.45, 0.49})
      for (const int cells : {1, 2, 4}) {
        const bool second = element == TetElement::second_order;
        if (cells == (second ? 4 : 1)) continue;
        const Stopwatch watch;
        const double ratio = tet_beam_ratio({.cells = cells,
                                             .poisson_ratio = nu,
                                             .nodal_pressure = element == TetElement::nodal,
                                             .second_order = second});
        fmt::print("  {:17} nu {:.2f} {} cells thick, 6 tets each {:.4f}\n", word_of(element), nu, cells,
                   ratio);
        json.push_back({{"elements", word_of(element)},
                        {"poisson_ratio", nu},
                        {"cells", cells},
                        {"ratio", ratio},
                        {"cpu_s", watch.cpu_s()}});
      }
  return json;
}

}  // namespace palpate::bench
