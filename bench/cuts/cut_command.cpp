// palpate bench cut: strokes of a scalpel that nobody should make, and what must hold after each.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "bench/cuts/cut_run.h"
#include "bench/machine/result_folder.h"
#include "bench/subcommands.h"
#include "common/error/error.h"

namespace palpate::bench {
namespace {

struct Options {
  std::string out = "out/bench_cut";
  std::vector<std::string> kinds = cut_kinds();
  std::uint64_t seeds = 100, first = 1;
};

CutKind kind_of(const std::string& name) {
  return static_cast<CutKind>(std::ranges::find(cut_kinds(), name) - cut_kinds().begin());
}

struct Sum {
  std::uint64_t blocks = 0, at_fault = 0;
  std::int64_t strokes = 0, opened = 0;
  double mass = 0, momentum = 0, balance = 0, least_J = 1;
  std::vector<double> balances;

  void add(const CutResult& r) {
    ++blocks;
    at_fault += faults(r).empty() ? 0 : 1;
    strokes += r.strokes, opened += r.opened;
    mass = std::max(mass, r.mass_off);
    momentum = std::max({momentum, r.momentum_off, r.angular_off});
    balance = std::max(balance, r.balance_error);
    least_J = std::min(least_J, r.least_J);
    balances.push_back(r.balance_error);
  }
  double balance_of(double share) {
    std::ranges::sort(balances);
    return balances[static_cast<std::size_t>(share * static_cast<double>(balances.size() - 1))];
  }
};

int run_cut(const Options& options) {
  const ResultFolder folder(options.out, "cut");
  Table table{cut_heading(), {}};
  nlohmann::json json;
  bool clean = true;
  for (const std::string& name : options.kinds) {
    Sum sum;
    for (std::uint64_t seed = options.first; seed < options.first + options.seeds; ++seed) {
      const CutResult result = run_cuts(kind_of(name), seed, options.out);
      table.add(words(result));
      sum.add(result);
      if (const std::string what = faults(result); !what.empty())
        fmt::print("{} seed {}: {} (gives way by {:.2g} cells, least corner J {:.2g})\n", name, seed, what,
                   result.gives_way, result.least_J);
      std::fflush(stdout);
    }
    clean = clean && sum.at_fault == 0;
    const double median = sum.balance_of(0.5), p99 = sum.balance_of(0.99);
    fmt::print(
        "{}: {} blocks, {} strokes, {} elements or faces opened; mass off by {:.2g} at most, momenta by "
        "{:.2g}; books by {:.2g}, {:.2g} and {:.2g} "
        "(median, 99 %, most); {} at fault\n",
        name, sum.blocks, sum.strokes, sum.opened, sum.mass, sum.momentum, median, p99, sum.balance,
        sum.at_fault);
    json[name] = {{"blocks", sum.blocks},
                  {"strokes", sum.strokes},
                  {"opened", sum.opened},
                  {"mass_off", sum.mass},
                  {"momentum_off", sum.momentum},
                  {"balance_error", {{"median", median}, {"p99", p99}, {"most", sum.balance}}},
                  {"least_corner_J", sum.least_J},
                  {"at_fault", sum.at_fault}};
  }
  for (const char* made : {"block.msh", "block.h5"}) std::filesystem::remove(options.out + "/" + made);
  folder.write_csv(table);
  folder.write_json(json);
  fmt::print("results: {}\n", options.out);
  return clean ? exit_ok : exit_failed;
}

}  // namespace

void add_cut(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "cut", "random strokes of a scalpel: no mass, momentum or energy is lost, and surfaces stay closed");
  auto options = std::make_shared<Options>();
  command->add_option("--of", options->kinds, "what is cut")
      ->delimiter(',')
      ->check(CLI::IsMember(cut_kinds()));
  command->add_option("--seeds", options->seeds, "how many blocks of each, of one to four strokes")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command->add_option("--first", options->first, "the first seed")->capture_default_str();
  command->add_option("--out", options->out, "folder of the results")->capture_default_str();
  command->callback([options, &exit_code] { exit_code = run_cut(*options); });
}

}  // namespace palpate::bench
