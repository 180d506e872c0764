#include "bench/fem/lump_rows.h"

#include <fmt/format.h>

#include "bench/fem/lump_cost.h"

namespace palpate::bench {

nlohmann::json lump_rows(int rounds) {
  constexpr int along = 40;
  fmt::print("frames of 1 ms of a cube of 10 kPa with a hard ball in it, one thread; median of {} rounds\n",
             rounds);
  std::vector<LumpKind> kinds;
  for (const double contrast : {10.0, 100.0})
    for (const double lag : {5e-5, 1e-4})
      for (const bool subcycle : {false, true})
        kinds.push_back({.contrast = contrast, .lag = lag, .subcycle = subcycle});
  nlohmann::json json;
  for (const LumpCost& cost : measure_lumps(kinds, along, rounds)) {
    fmt::print(
        "  {:3.0f} : 1, viscosity over modulus {:.2f} ms, {:4} of {} cells with steps of their own: {:3.0f} "
        "steps a "
        "frame  {:7.1f} ns a cell and frame  {:6.0f} cells at 1 kHz\n",
        cost.kind.contrast, 1e3 * cost.kind.lag, cost.fast_cells, cost.cells, 1e-3 / cost.step,
        cost.median_ns(), cost.cells_at_1_kHz());
    json.push_back({{"contrast", cost.kind.contrast},
                    {"lag_s", cost.kind.lag},
                    {"subcycle", cost.kind.subcycle},
                    {"cells", cost.cells},
                    {"fast_cells", cost.fast_cells},
                    {"step_s", cost.step},
                    {"ns_per_cell_and_frame", cost.median_ns()},
                    {"cells_at_1_kHz", cost.cells_at_1_kHz()}});
  }
  return json;
}

}  // namespace palpate::bench
