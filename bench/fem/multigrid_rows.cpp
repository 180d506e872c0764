#include "bench/fem/multigrid_rows.h"

#include <fmt/format.h>

#include "bench/fem/multigrid_cost.h"

namespace palpate::bench {

namespace {

nlohmann::json rows_of(const std::vector<SolidKind>& kinds, int rounds) {
  fmt::print("V-cycles of a push in a frame of 20 ms, 100 kPa, float; least of {} rounds\n", rounds);
  nlohmann::json json;
  for (SolidKind kind : kinds)
    for (const int threads : {1, 2}) {
      if (!kind.image) kind.edge = 0.08 / kind.cells;
      if (kind.shape == SolidShape::lump) kind.modulus = 10e3;
      const CycleCost cost = measure_cycles(kind, threads, rounds);
      const char* shape = solid_shape_names[static_cast<int>(kind.shape)];
      fmt::print(
          "  {:5} nu {:.2f} {:2} along a side, {:6} cells {} threads {:2} V-cycles to 1e-2, {:2} to 1e-4  "
          "{:6.1f} "
          "ns a cell and V-cycle, {:6.1f} for the tangent\n",
          shape, kind.poisson_ratio, kind.cells, cost.cells, threads, cost.to_hundredth,
          cost.to_ten_thousandth, cost.cycle_ns, cost.tangent_ns);
      json.push_back({{"shape", shape},
                      {"poisson_ratio", kind.poisson_ratio},
                      {"cells_along_a_side", kind.cells},
                      {"cells", cost.cells},
                      {"threads", threads},
                      {"cycles_to_1e-2", cost.to_hundredth},
                      {"cycles_to_1e-4", cost.to_ten_thousandth},
                      {"ns_per_cell_and_cycle", cost.cycle_ns},
                      {"ns_per_cell_of_tangent", cost.tangent_ns}});
    }
  return json;
}

}  // namespace

nlohmann::json cycle_rows(int rounds) {
  std::vector<SolidKind> kinds{{.cells = 16},
                               {.cells = 32},
                               {.cells = 64},
                               {.cells = 96},
                               {.cells = 16, .poisson_ratio = 0.49},
                               {.poisson_ratio = 0.49},
                               {.cells = 64, .poisson_ratio = 0.49},
                               {.shape = SolidShape::lump, .cells = 16},
                               {.shape = SolidShape::lump},
                               {.shape = SolidShape::lump, .cells = 64},
                               {.shape = SolidShape::blob, .cells = 24},
                               {.shape = SolidShape::blob, .cells = 48},
                               {.shape = SolidShape::blob, .cells = 48, .poisson_ratio = 0.49},
                               {.shape = SolidShape::tube, .cells = 24},
                               {.shape = SolidShape::tube, .cells = 48},
                               {.shape = SolidShape::slit, .cells = 16},
                               {.shape = SolidShape::slit}};
  return rows_of(kinds, rounds);
}

nlohmann::json cycle_rows_of(const VolumeShape& image, int rounds) {
  std::vector<SolidKind> kinds;
  for (const double nu : {0.45, 0.49})
    kinds.push_back({.shape = SolidShape::image, .cells = 0, .poisson_ratio = nu, .image = image});
  return rows_of(kinds, rounds);
}

nlohmann::json frame_rows() {
  fmt::print("frames of 20 ms, cells of 2.5 mm, the top pressed in by about a tenth in 25 frames; medians\n");
  nlohmann::json json;
  for (const auto shape : {SolidShape::cube, SolidShape::lump})
    for (const double modulus : {10e3, 100e3, 1e6})
      for (const int threads : {1, 2}) {
        if (shape == SolidShape::lump && modulus > 10e3) continue;
        const FrameCost cost = measure_frames({.shape = shape, .modulus = modulus}, threads);
        const char* name = solid_shape_names[static_cast<int>(shape)];
        fmt::print(
            "  {} {:4.0f} kPa {} threads {:.1f} Newton {:.1f} V-cycles {:6.0f} ns a cell and frame: {:6.0f} "
            "cells "
            "in real time, {:6.0f} by explicit steps of {:.3f} ms ({:.1f} ns); implicit is cheaper from "
            "frames of "
            "{:.1f} ms\n",
            name, 1e-3 * modulus, threads, cost.newton, cost.cycles, cost.implicit_ns,
            cost.cells_in_real_time(), cost.explicit_cells_in_real_time(), 1e3 * cost.explicit_step,
            cost.explicit_ns, 1e3 * cost.break_even());
        json.push_back({{"shape", name},
                        {"modulus_kPa", 1e-3 * modulus},
                        {"threads", threads},
                        {"cells", cost.cells},
                        {"newton_per_frame", cost.newton},
                        {"cycles_per_frame", cost.cycles},
                        {"ns_per_cell_and_frame", cost.implicit_ns},
                        {"cells_in_real_time", cost.cells_in_real_time()},
                        {"explicit_step_s", cost.explicit_step},
                        {"explicit_ns_per_cell_and_step", cost.explicit_ns},
                        {"explicit_cells_in_real_time", cost.explicit_cells_in_real_time()},
                        {"break_even_s", cost.break_even()}});
      }
  return json;
}

}  // namespace palpate::bench
