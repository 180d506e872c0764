// palpate bench fem: what a finite element costs and how far it is from the truth, beside springs.

#include <fmt/format.h>

#include <memory>

#include "bench/fem/error_rows.h"
#include "bench/fem/hex_cost.h"
#include "bench/fem/hex_work.h"
#include "bench/fem/lump_rows.h"
#include "bench/fem/multigrid_rows.h"
#include "bench/fem/spring_beam.h"
#include "bench/fem/tet_rows.h"
#include "bench/machine/limits.h"
#include "bench/machine/result_folder.h"
#include "bench/problems/hex_beam.h"
#include "bench/problems/settings.h"
#include "bench/problems/stopwatch.h"
#include "bench/subcommands.h"
#include "common/error/error.h"
#include "physics_node/step/lattice/element_context.h"

namespace palpate::bench {
namespace {

struct Options {
  std::string out = "out/bench_fem";
  int rounds = 15;
  std::string volume;                    // of an image; empty: none
  std::pair<double, double> keep{0, 0};  // its intensities that are tissue
};

const char* word_of(HourglassKind hourglass) {
  return hourglass == HourglassKind::physical ? "physical" : "isotropic";
}

const char* losing(const HexCubeKind& kind) {
  return kind.relaxing ? "relaxing" : kind.damped ? "damped" : "undamped";
}

nlohmann::json kernel_rows(int rounds, Table& table) {
  std::vector<HexCubeKind> kinds;
  for (const auto hourglass : {HourglassKind::physical, HourglassKind::isotropic})
    for (const bool damped : {false, true})
      for (const int threads : {1, 2})
        kinds.push_back({.hourglass = hourglass, .damped = damped, .threads = threads});
  kinds.push_back({.damped = false, .relaxing = true});
  kinds.push_back({.precision = Precision::double_, .threads = 1});
  kinds.push_back({.cells = 20});
  kinds.push_back({.cells = 64});
  const double roof = fma_flops_per_s(true);
  fmt::print("a step of a cube, vectors {}; median of {} rounds; fused operations at most {:.0f} GFLOP/s\n",
             physics::name_of(physics::instruction_set()), rounds, 1e-9 * roof);
  nlohmann::json json;
  for (const HexCost& cost : measure_hex_costs(kinds, rounds)) {
    const HexCubeKind& kind = cost.kind;
    const double flops = flops_per_cell(kind);
    const double share = flops / (1e-9 * cost.median_ns()) / (roof * kind.threads);
    fmt::print(
        "  {:9} {:9} {:6} {:3}^3 cells {} threads {:7.2f} ns a cell (least {:.2f})  {:4.0f} flops  {:3.0f} % "
        "of "
        "the roof  stable step {:.3f} ms  {:6.0f} cells at 1 kHz\n",
        word_of(kind.hourglass), losing(kind), name_of(kind.precision), kind.cells, kind.threads,
        cost.median_ns(), cost.least_ns(), flops, 100 * share, 1e3 * cost.stable_step, cost.cells_at_1_kHz());
    table.add({word_of(kind.hourglass), losing(kind), name_of(kind.precision), std::to_string(kind.cells),
               std::to_string(kind.threads), text_of(cost.median_ns()), text_of(cost.least_ns()),
               text_of(flops), text_of(bytes_per_cell(kind)), text_of(share), text_of(cost.stable_step),
               text_of(cost.cells_at_1_kHz())});
    json.push_back({{"hourglass", word_of(kind.hourglass)},
                    {"damped", kind.damped},
                    {"relaxing", kind.relaxing},
                    {"precision", name_of(kind.precision)},
                    {"cells_along_a_side", kind.cells},
                    {"threads", kind.threads},
                    {"ns_per_cell", cost.median_ns()},
                    {"ns_per_cell_least", cost.least_ns()},
                    {"flops_per_cell", flops},
                    {"share_of_roof", share},
                    {"stable_step_s", cost.stable_step},
                    {"cells_at_1_kHz", cost.cells_at_1_kHz()}});
  }
  return json;
}

nlohmann::json beam_rows() {
  fmt::print(
      "a cantilever under its weight: tip over that of quadratic bricks (CalculiX C3D20R); springs over "
      "Timoshenko's beam\n");
  nlohmann::json json;
  for (const auto hourglass : {HourglassKind::physical, HourglassKind::isotropic})
    for (const double nu : {0.3, 0.45, 0.49})
      for (const int cells : {2, 4, 8}) {
        if (cells == 8 && nu != 0.45) continue;  // takes seconds, and shows the same
        const Stopwatch watch;
        const HexBeam beam({.cells = cells, .poisson_ratio = nu, .hourglass = hourglass});
        const double ratio = beam.tip() / beam.calculix();
        fmt::print("  {:9} nu {:.2f} {} cells thick {:.4f}\n", word_of(hourglass), nu, cells, ratio);
        json.push_back({{"elements", word_of(hourglass)},
                        {"poisson_ratio", nu},
                        {"cells", cells},
                        {"ratio", ratio},
                        {"cpu_s", watch.cpu_s()}});
      }
  for (const int cells : {2, 4, 8}) {
    const SpringBeam beam = spring_beam(cells);
    fmt::print("  springs           {} cells thick {:.4f}\n", cells, beam.ratio);
    json.push_back({{"elements", "springs"}, {"cells", cells}, {"ratio", beam.ratio}});
  }
  return json;
}

/// V-cycles alone, of the tissue of a volume.
int run_volume(const Options& options) {
  const ResultFolder folder(options.out, "fem");
  nlohmann::json json;
  json["cycles"] = cycle_rows_of({.file = options.volume,
                                  .keep_min = options.keep.first,
                                  .keep_max = options.keep.second,
                                  .partition = std::nullopt,
                                  .deformable = {},
                                  .largest_component = true},
                                 options.rounds);
  folder.write_json(json);
  fmt::print("results: {}\n", options.out);
  return exit_ok;
}

int run_fem(const Options& options) {
  const ResultFolder folder(options.out, "fem");
  Table table{{"hourglass", "damper", "precision", "cells_along_a_side", "threads", "ns_per_cell",
               "ns_per_cell_least", "flops_per_cell", "bytes_per_cell", "share_of_roof", "stable_step_s",
               "cells_at_1_kHz"},
              {}};
  nlohmann::json json;
  json["kernel"] = kernel_rows(options.rounds, table);
  json["tet_kernel"] = tet_kernel_rows(options.rounds, fma_flops_per_s(true), table);
  json["lumps"] = lump_rows(options.rounds);
  json["cycles"] = cycle_rows(options.rounds);
  json["frames"] = frame_rows();
  json["beam"] = beam_rows();
  json["tet_beam"] = tet_beam_rows();
  json["error"] = error_rows();
  folder.write_csv(table);
  folder.write_json(json);
  const bool drawn = folder.plot();
  fmt::print("results: {}\n", options.out);
  return drawn ? exit_ok : exit_failed;
}

}  // namespace

void add_fem(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("fem", "what a finite element costs, and how far it is from the truth");
  auto options = std::make_shared<Options>();
  command->add_option("--out", options->out, "folder of the results")->capture_default_str();
  command->add_option("--rounds", options->rounds, "of each row, in turns; the median counts")
      ->capture_default_str()
      ->check(CLI::Range(1, 999));
  auto* volume =
      command->add_option("--volume", options->volume, "nothing but V-cycles of the tissue of this volume")
          ->check(CLI::ExistingFile);
  auto* keep =
      command->add_option("--keep", options->keep, "of the volume: lowest and highest intensity of tissue");
  volume->needs(keep);
  keep->needs(volume);
  command->callback([options, &exit_code] {
    exit_code = options->volume.empty() ? run_fem(*options) : run_volume(*options);
  });
}

}  // namespace palpate::bench
