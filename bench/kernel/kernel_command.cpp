// palpate bench kernel: time of a step per mass, over lattices, precisions, laws, sizes and threads.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdio>
#include <map>
#include <memory>

#include "bench/kernel/kernel_results.h"
#include "bench/problems/settings.h"
#include "bench/subcommands.h"
#include "common/error/error.h"
#include "common/process/checked_option.h"
#include "physics_node/step/lattice/element_context.h"

namespace palpate::bench {
namespace {

struct Options {
  std::string out = "out/bench_kernel";
  std::string filter;
  double min_time_s = 0.1;
  int repetitions = 5;
  bool quick = false, large = false;
};

std::string name_of_row(const CubeKind& kind, int threads) {
  return fmt::format("{}/{}/{}/{:.0f}/{}", kind.lattice == LatticeKind::fcc ? "fcc" : "voxel",
                     name_of(kind.precision), name_of(kind.work), kind.masses, threads);
}

/// Rows in the order of registration; Google Benchmark runs those that the filter fits, each several times.
class Rows {
 public:
  std::size_t add(const CubeKind& kind, int threads) {
    rows_.push_back({});
    rows_.back().kind = kind;
    rows_.back().threads = threads;
    numbers_[name_of_row(kind, threads)] = rows_.size() - 1;
    return rows_.size() - 1;
  }
  KernelRow& named(const std::string& name) { return rows_[numbers_.at(name)]; }

  void time_row(std::size_t n, benchmark::State& state) {
    KernelRow& row = rows_[n];
    if (!cube_.body ||
        !(cube_kind_ == row.kind)) {  // the next size replaces the last one: one cube in memory
      cube_ = {};
      cube_ = make_cube(row.kind);
      cube_kind_ = row.kind;
    }
    const physics::Body& body = cube_.body->body();
    row.masses = body.lattice.n_masses();
    row.elements = body.lattice.n_elements();
    row.work = work_per_mass(row.kind, body);
    row.stable_step = cube_.stable_step;
    set_moving(row.kind, cube_, row.threads);
    for (auto _ : state) step(cube_, row.threads);
    if (!cube_.body->is_finite()) state.SkipWithError("the state is not finite");
  }

  std::vector<KernelRow>& rows() { return rows_; }

 private:
  std::vector<KernelRow> rows_;
  std::map<std::string, std::size_t> numbers_;
  Cube cube_;
  CubeKind cube_kind_;
};

/// Keeps the times and prints a line as soon as a row is complete.
class RowReporter : public benchmark::BenchmarkReporter {
 public:
  explicit RowReporter(Rows& rows) : rows_(rows) {}
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    KernelRow* row = nullptr;
    for (const Run& run : runs) {
      if (run.error_occurred)
        failed_ = true, std::fprintf(stderr, "palpate bench: %s: %s\n", run.benchmark_name().c_str(),
                                     run.error_message.c_str());
      if (run.error_occurred || run.run_type != Run::RT_Iteration) continue;
      row = &rows_.named(run.run_name.function_name);
      row->ns.push_back(run.GetAdjustedRealTime() / static_cast<double>(row->masses));
    }
    if (row != nullptr) fmt::print("{}\n", line_of(*row)), std::fflush(stdout);
  }
  bool failed() const { return failed_; }

 private:
  Rows& rows_;
  bool failed_ = false;
};

void register_rows(const Options& options, Rows& rows) {
  std::vector<double> sizes = {1e3, 4e3, 1.6e4, 8.5e4, 2.5e5, 1e6};
  if (options.quick) sizes = {1e3, 8.5e4};
  if (options.large) sizes.push_back(1e7);
  for (const LatticeKind lattice : {LatticeKind::fcc, LatticeKind::voxel})
    for (const Precision precision : {Precision::single_, Precision::double_})
      for (const Work work : {Work::undamped, Work::damped, Work::plastic, Work::yielding})
        for (const double masses : sizes)
          for (const int threads : {1, 2}) {
            const CubeKind kind{lattice, precision, work, masses};
            const std::size_t n = rows.add(kind, threads);
            benchmark::RegisterBenchmark(name_of_row(kind, threads).c_str(),
                                         [&rows, n](benchmark::State& state) { rows.time_row(n, state); })
                ->UseRealTime()
                ->Unit(benchmark::kNanosecond);
          }
}

int run_kernel(const Options& options) {
  const ResultFolder folder(options.out, "kernel");
  Rows rows;
  register_rows(options, rows);
  std::vector<std::string> words = {"palpate-bench",
                                    fmt::format("--benchmark_min_time={}", options.min_time_s),
                                    fmt::format("--benchmark_repetitions={}", options.repetitions)};
  if (!options.filter.empty()) words.push_back("--benchmark_filter=" + options.filter);
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  int argc = static_cast<int>(argv.size());
  benchmark::Initialize(&argc, argv.data());
  fmt::print("vectors: {}; median of {} repetitions\n", physics::name_of(physics::instruction_set()),
             options.repetitions);
  RowReporter reporter(rows);
  if (benchmark::RunSpecifiedBenchmarks(&reporter) == 0)
    throw InputError(fmt::format("--filter {}: fits no row; a row is lattice/precision/work/masses/threads",
                                 options.filter));
  std::vector<KernelRow> done;
  for (const auto& row : rows.rows())
    if (!row.ns.empty()) done.push_back(row);
  const bool drawn = !done.empty() && write_kernel_results(folder, done);
  fmt::print("results: {}\n", folder.file(".csv").parent_path().string());
  return drawn && !reporter.failed() ? exit_ok : exit_failed;
}

}  // namespace

void add_kernel(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("kernel", "time of a step per mass, and what the machine could do");
  auto options = std::make_shared<Options>();
  command->add_option("--out", options->out, "folder of the results")->capture_default_str();
  command->add_option("--filter", options->filter, "rows to run, as a regular expression: fcc/single/damped");
  command->add_option("--min-time", options->min_time_s, "of a repetition [s]")
      ->capture_default_str()
      ->check(number_in({.lo = 0, .hi = 600, .without_lo = true}));
  command->add_option("--repetitions", options->repetitions, "of a row; the median counts")
      ->capture_default_str();
  command->add_flag("--quick", options->quick, "two sizes only");
  command->add_flag("--large", options->large, "ten million masses too (several GiB)");
  command->callback([options, &exit_code] { exit_code = run_kernel(*options); });
}

}  // namespace palpate::bench
