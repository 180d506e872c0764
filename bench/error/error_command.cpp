// palpate bench error: how far from the truth, for how much time.

#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "bench/error/sweep.h"
#include "bench/machine/result_folder.h"
#include "bench/subcommands.h"
#include "common/error/error.h"

namespace palpate::bench {
namespace {

struct Options {
  std::string out = "out/bench_error";
  SweepChoice choice;
};

std::vector<std::string> words(const SweepRow& row) {
  const Settings& s = row.settings;
  return {row.problem,
          name_of(s.integrator),
          name_of(s.precision),
          std::to_string(s.threads),
          text_of(s.step),
          std::to_string(row.outcome.steps),
          std::to_string(row.outcome.masses),
          text_of(row.outcome.error),
          text_of(row.outcome.cpu_s)};
}

/// What has no step to vary: the law's memory, the conservation laws, the modulus over the spacing.
nlohmann::json exact_laws(bool quick) {
  nlohmann::json json;
  double loop = 0;
  for (const double speed : {1e-3, 1.0, 100.0})
    for (const int steps : {1, 10, 1000}) loop = std::max(loop, bilinear_loop_error(speed, steps));
  json["bilinear_loop"] = loop;
  fmt::print(
      "bilinear loop: largest error of the tension {:.2g} of k1 L, 1 mm/s to 100 m/s, 1 to 1000 steps\n",
      loop);
  for (const LatticeKind lattice : {LatticeKind::fcc, LatticeKind::voxel}) {
    const std::string name = lattice == LatticeKind::fcc ? "fcc" : "voxel";
    const Settings settings{Integrator::symplectic_euler, Precision::double_, 2e-4, 1};
    const Drift drift = free_flight(settings, lattice, quick ? 10000 : 100000);
    json["free_flight"][name] = {
        {"steps", drift.outcome.steps}, {"linear", drift.linear}, {"angular", drift.angular}};
    fmt::print("free flight, {}: momentum {:.2g}, angular momentum {:.2g} after {} steps\n", name,
               drift.linear, drift.angular, drift.outcome.steps);
    for (const int cells : {5, 10, 20}) {
      const Modulus modulus = bar_modulus(lattice, cells);
      json["modulus"][name].push_back({{"cells", cells},
                                       {"masses", modulus.masses},
                                       {"inside", modulus.inside},
                                       {"outside", modulus.outside}});
      fmt::print("modulus, {}, {} cells wide: {:+.2f} % inside, {:+.2f} % outside\n", name, cells,
                 100 * (modulus.inside - 1), 100 * (modulus.outside - 1));
      if (quick && cells == 10) break;
    }
    std::fflush(stdout);
  }
  return json;
}

int run_error(const Options& options) {
  const ResultFolder folder(options.out, "error");
  Table table{
      {"problem", "integrator", "precision", "threads", "step_s", "steps", "masses", "error", "cpu_s"}, {}};
  nlohmann::json results;
  const auto rows = sweep(options.choice, [&table](const SweepRow& row) {
    table.add(words(row));
    fmt::print("{:16} {:16} {:6} {} threads  step {:9.3g} s  error {:9.3g}  {:9.3g} s of CPU\n", row.problem,
               name_of(row.settings.integrator), name_of(row.settings.precision), row.settings.threads,
               row.settings.step, row.outcome.error, row.outcome.cpu_s);
    std::fflush(stdout);
  });
  if (rows.empty())
    throw InputError(fmt::format("--only {}: no such problem; see --help", options.choice.only));
  for (const auto& order : observed_orders(rows)) {
    results["orders"].push_back(
        {{"problem", order.problem}, {"integrator", name_of(order.integrator)}, {"order", order.order}});
    fmt::print("observed order of {:16} in {:16} {:.2f}\n", name_of(order.integrator), order.problem,
               order.order);
  }
  for (const Problem& problem : problems()) results["error_is_relative_to"][problem.name] = problem.error_is;
  if (options.choice.only.empty()) results["exact"] = exact_laws(options.choice.quick);
  folder.write_csv(table);
  folder.write_json(results);
  const bool drawn = folder.plot();
  fmt::print("results: {}\n", folder.file(".csv").parent_path().string());
  return drawn ? exit_ok : exit_failed;
}

}  // namespace

void add_error(CLI::App& app, int& exit_code) {
  auto* command =
      app.add_subcommand("error", "error against run time, over integrators, steps and precisions");
  auto options = std::make_shared<Options>();
  std::string names;
  for (const Problem& problem : problems()) names += (names.empty() ? "" : ", ") + problem.name;
  command->add_option("--out", options->out, "folder of the results")->capture_default_str();
  command->add_option("--only", options->choice.only, "one problem: " + names);
  command->add_flag("--quick", options->choice.quick, "fewer steps, double precision, one thread");
  command->callback([options, &exit_code] { exit_code = run_error(*options); });
}

}  // namespace palpate::bench
