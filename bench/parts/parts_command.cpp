// palpate bench parts: a body of which only what is near to the finger is computed, against all of it.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <memory>
#include <numbers>

#include "bench/machine/result_folder.h"
#include "bench/parts/pressed_block.h"
#include "bench/subcommands.h"
#include "common/error/error.h"

namespace palpate::bench {
namespace {

constexpr double frame_s = 1e-3;
constexpr double steady = 0.1, swing = 0.02;          // [N]
constexpr int to_rest = 400, drag = 1000, tap = 100;  // frames

struct Options {
  std::string out = "out/bench_parts";
  std::vector<double> awake_mm{10, 12.5, 15, 20, 30};
  double nu = 0.45;
};

/// The first harmonic of the last whole periods [m].
std::complex<double> swing_of(const std::vector<double>& depth, double Hz) {
  const int period = static_cast<int>(std::round(1 / (Hz * frame_s)));
  const int n = std::max(1, 400 / period) * period;
  const auto first = static_cast<int>(depth.size()) - n;
  std::complex<double> sum = 0;
  for (int i = first; i < first + n; ++i)
    sum += depth[static_cast<std::size_t>(i)] * std::polar(1.0, -2 * std::numbers::pi * Hz * frame_s * i);
  return 2.0 / n * sum;
}

/// What is compared.
struct Answers {
  double rest = 0, peak = 0;                      // depth [m]
  std::complex<double> at_2, at_5, at_10, at_20;  // [m]
  std::vector<double> dragged;                    // depth [m]
  double cpu_ms_a_frame = 0, awake_share = 0, numerical = 0, off = 0;
};

Answers answers_of(const PressedBlock& block) {
  Answers a;
  const Pressed rest = press(block, to_rest, [](int) { return Press{steady}; });
  a.rest = rest.depth.back();
  a.cpu_ms_a_frame = 1e3 * rest.cpu_s / to_rest;
  a.awake_share = rest.awake_share;
  const auto swung = [&](double Hz) {
    const int frames = to_rest + std::max(400, static_cast<int>(2 / (Hz * frame_s)));
    return swing_of(press(block, frames,
                          [&](int n) {
                            return Press{steady + swing * std::sin(2 * std::numbers::pi * Hz * frame_s * n)};
                          })
                        .depth,
                    Hz);
  };
  a.at_2 = swung(2), a.at_5 = swung(5), a.at_10 = swung(10), a.at_20 = swung(20);
  const Pressed tapped = press(block, 2 * tap, [](int n) {
    return Press{n < tap ? 2 * steady * std::pow(std::sin(std::numbers::pi * n / tap), 2) : 0};
  });
  a.peak = *std::ranges::max_element(tapped.depth);
  const Pressed dragged = press(block, to_rest + drag, [](int n) {
    return Press{steady, Vec3(-0.02 + 4e-5 * std::max(0, n - to_rest), 0, 0)};
  });
  a.dragged.assign(dragged.depth.begin() + to_rest, dragged.depth.end());
  a.numerical = dragged.numerical / dragged.exchanged;
  a.off = dragged.off;
  return a;
}

double percent(double now, double all) { return 100 * (now / all - 1); }
std::string swung_words(std::complex<double> now, std::complex<double> all) {
  const std::complex<double> ratio = now / all;
  return fmt::format("{:+.2f} % {:+.2f} deg", 100 * (std::abs(ratio) - 1),
                     180 / std::numbers::pi * std::arg(ratio));
}

int run_parts(const Options& options) {
  const ResultFolder folder(options.out, "parts");
  PressedBlock block;
  block.folder = options.out;
  block.poisson_ratio = options.nu;
  const Answers all = answers_of(block);
  Table table{{"awake_mm", "awake_share", "depth_at_rest_percent", "swing_2_Hz", "swing_5_Hz", "swing_10_Hz",
               "swing_20_Hz", "tap_percent", "drag_mean_percent", "drag_most_percent",
               "drag_most_in_10_ms_percent", "drag_numerical", "drag_books_off", "cpu_ms_a_frame"},
              {}};
  nlohmann::json json;
  const auto add = [&](const std::string& name, const Answers& a) {
    double mean = 0, most = 0, jump = 0;
    for (std::size_t n = 0; n < a.dragged.size(); ++n) {
      const double off = percent(a.dragged[n], all.dragged[n]);
      mean += off / static_cast<double>(a.dragged.size());
      most = std::max(most, std::abs(off));
      if (n >= 10) jump = std::max(jump, std::abs(off - percent(a.dragged[n - 10], all.dragged[n - 10])));
    }
    const auto two = [](double x) { return fmt::format("{:+.2f}", x); };
    table.add({name, text_of(a.awake_share), two(percent(a.rest, all.rest)), swung_words(a.at_2, all.at_2),
               swung_words(a.at_5, all.at_5), swung_words(a.at_10, all.at_10),
               swung_words(a.at_20, all.at_20), two(percent(a.peak, all.peak)), two(mean), two(most),
               two(jump), text_of(a.numerical), text_of(a.off), text_of(a.cpu_ms_a_frame)});
    json[name] = {{"depth_at_rest_percent", percent(a.rest, all.rest)},
                  {"tap_percent", percent(a.peak, all.peak)},
                  {"drag_percent", {{"mean", mean}, {"most", most}, {"most_in_10_ms", jump}}},
                  {"drag_numerical", a.numerical},
                  {"drag_books_off", a.off},
                  {"awake_share", a.awake_share},
                  {"cpu_ms_a_frame", a.cpu_ms_a_frame}};
    fmt::print(
        "{}: {:.2f} % of the masses awake, {:.3f} ms of CPU a frame\n"
        "  depth at rest {:+.2f} %, of a tap {:+.2f} %; dragged {:+.2f} % in the mean, {:.2f} at most, "
        "{:.2f} "
        "within 10 ms; numerical {:.4f} of what was exchanged, books off by {:.4f}\n"
        "  swings at 2 Hz {}, 5 Hz {}, 10 Hz {}, 20 Hz {}\n",
        name, 100 * a.awake_share, a.cpu_ms_a_frame, percent(a.rest, all.rest), percent(a.peak, all.peak),
        mean, most, jump, a.numerical, a.off, swung_words(a.at_2, all.at_2), swung_words(a.at_5, all.at_5),
        swung_words(a.at_10, all.at_10), swung_words(a.at_20, all.at_20));
    std::fflush(stdout);
  };
  add("all", all);
  for (const double mm : options.awake_mm) {
    block.awake = 1e-3 * mm;
    add(fmt::format("{:g} mm", mm), answers_of(block));
  }
  folder.write_csv(table);
  folder.write_json(json);
  fmt::print("results: {}\n", options.out);
  return exit_ok;
}

}  // namespace

void add_parts(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "parts", "a body of which only what is near to the finger is computed, against all of it");
  auto options = std::make_shared<Options>();
  command->add_option("--awake-mm", options->awake_mm, "radii that are compared")->delimiter(',');
  command->add_option("--nu", options->nu, "Poisson's ratio")->check(CLI::Range(0.0, 0.495));
  command->add_option("--out", options->out, "folder of the results")->capture_default_str();
  command->callback([options, &exit_code] { exit_code = run_parts(*options); });
}

}  // namespace palpate::bench
