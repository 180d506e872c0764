#include <fmt/format.h>

#include "deploy/palpate/child.h"
#include "deploy/palpate/doctor.h"
#include "deploy/palpate/install_paths.h"
#include "deploy/palpate/nodes.h"
#include "deploy/palpate/plotter.h"
#include "deploy/palpate/probe_gl.h"

namespace palpate::deploy {
namespace fs = std::filesystem;

Finding check_nodes() {
  std::string missing;
  for (const NodeKind node : all_nodes) {
    const std::string name = fmt::format("palpate-{}", name_of(node));
    if (!is_program(bin_folder() / name)) missing += (missing.empty() ? "" : ", ") + name;
  }
  if (missing.empty())
    return {"nodes", Finding::State::ok, "physics, haptic and render are beside this program"};
  return {"nodes", Finding::State::fails,
          missing + " not beside this program; build or install palpate again"};
}

Finding check_plotter() {
  if (plotter_program().empty()) {
    return {"plots", Finding::State::lacks, "plot_run.py is missing; install palpate again"};
  }
  const fs::path python = plot_interpreter();
  const bool draws = is_program(python) && Child(python, {"-c",
                                                          "import importlib.util as i, sys; "
                                                          "sys.exit(i.find_spec('matplotlib') is None)"})
                                               .wait()
                                               .clean();
  if (draws) return {"plots", Finding::State::ok, "python3 with matplotlib"};
  return {"plots", Finding::State::lacks, "no matplotlib; install the package python3-matplotlib"};
}

Finding check_gl() {
  std::string what;
  const bool works = probe_gl(what);
  return {"GL", works ? Finding::State::ok : Finding::State::fails, what};
}

}  // namespace palpate::deploy
