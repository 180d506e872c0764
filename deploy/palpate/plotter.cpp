#include "deploy/palpate/plotter.h"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "deploy/palpate/child.h"
#include "deploy/palpate/install_paths.h"

namespace palpate::deploy {

std::filesystem::path plot_interpreter() { return "/usr/bin/python3"; }

std::filesystem::path plotter_program() {
  const auto program = share_folder() / "plot_run.py";
  return std::filesystem::exists(program) ? program : std::filesystem::path();
}

bool draw_plots(const std::filesystem::path& folder) {
  const auto program = plotter_program();
  if (program.empty()) {
    std::fprintf(stderr, "palpate: %s is missing; install palpate again\n",
                 (share_folder() / "plot_run.py").c_str());
    return false;
  }
  const auto python = plot_interpreter();
  if (!is_program(python)) {
    std::fprintf(stderr,
                 "palpate: no %s to draw plots with; install the packages python3 and python3-matplotlib\n",
                 python.c_str());
    return false;
  }
  return Child(python, {program.string(), folder.string()}).wait().clean();
}

void say_plots(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> plots;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool ours = name == "energy.png" || name.starts_with("force");
    if (ours && entry.path().extension() == ".png") plots.push_back(entry.path());
  }
  std::sort(plots.begin(), plots.end());
  for (const auto& plot : plots) std::printf("plot     %s\n", plot.c_str());
  if (plots.empty()) std::printf("plot     none: the session had no tool and recorded no energy\n");
}

}  // namespace palpate::deploy
