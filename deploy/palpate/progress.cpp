#include "deploy/palpate/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace palpate::deploy {
namespace {

constexpr double between_lines_s = 10;

}  // namespace

std::string progress_line(double t, double seconds, double wall_s, double& said_s) {
  if (wall_s - said_s < between_lines_s || t >= seconds) return {};
  said_s = wall_s;
  std::string line = fmt::format("{:.2f} of {:.2f} s simulated in {:.0f} s", t, seconds, wall_s);
  if (t > 0) line += fmt::format(", {:.0f} s to go", wall_s * (seconds - t) / t);
  return line;
}

Progress::Progress(double seconds) : seconds_(seconds), terminal_(isatty(STDERR_FILENO) != 0) {}

void Progress::show(double t) {
  if (!terminal_) {
    const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    const std::string line = progress_line(t, seconds_, wall_s, said_s_);
    if (!line.empty()) std::fprintf(stderr, "palpate: %s\n", line.c_str());
    return;
  }
  const auto done = static_cast<std::size_t>(40 * std::clamp(t / seconds_, 0.0, 1.0));
  std::fprintf(stderr, "\r  [%-40s] %.2f of %.2f s", std::string(done, '=').c_str(), t, seconds_);
  if (t >= seconds_) std::fputc('\n', stderr);
}

}  // namespace palpate::deploy
