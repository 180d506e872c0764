#include "physics_node/step/lattice/fast_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "common/scene/body_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "physics_node/step/lattice/hex_grid.h"
#include "physics_node/step/lattice/hex_spectrum.h"
#include "physics_node/step/lattice/stable_step.h"

namespace palpate::physics {
namespace {

/// Viscosity over modulus, over the step, that fast cells need. Forces that are held for a step feed vibrations of stiff cells; over lumps
/// of 1 to 6 cells along a side, moduli of 4 to 1000 times that of the rest and 0.8 of the stable step, 0.05 is enough and 0.02 is not.
constexpr double least_lag = 0.1;
/// Of a fast cell and substep over that of a cell in the sweep: corners are gathered one by one (palpate bench fem).
constexpr double dearer = 2.5;
constexpr double most_of_the_work = 2.0 / 3;
constexpr std::size_t most_levels = 64;  // of stiffness that are tried

struct Choice {
  std::vector<Index> cells;
  double rest = 0, own = 0;  // longest steps [s]
  double work = 1;           // over that of one step for all
  double steps = 0, substeps = 0;
  std::size_t n_cells = 0;  // of the body
};

class Chooser {
 public:
  /// @param fastest  w^2 of the body; @param all  its stable step
  Chooser(const Body& body, const Scene& scene, double fastest, double all)
      : body_(body),
        fastest_(fastest),
        frame_(1 / scene.physics->frame_Hz),
        safety_(scene.physics->safety),
        uniform_steps_(steps_of(all)) {
    for (const Index cell : body.nodes())
      if (body.solid->stiffness[static_cast<std::size_t>(cell)] > 0) cells_.push_back(cell);
  }

  /// Of all levels of stiffness the one that asks for least work, by what a cell alone would ask for; then for certain.
  std::optional<Choice> best() const {
    std::vector<float> levels;
    for (const Index cell : cells_) levels.push_back(stiffness(cell));
    std::sort(levels.begin(), levels.end());
    const std::vector<float> sorted = levels;
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    if (levels.size() < 2) return std::nullopt;
    const double unit = fastest_ / static_cast<double>(levels.back());
    const auto step = [&](float level) { return lagging(stable(unit * static_cast<double>(level))); };
    const double own = safety_ * stable(unit * static_cast<double>(levels.back()));
    double least = 1;
    std::size_t found = levels.size();
    const std::size_t stride = 1 + levels.size() / most_levels;
    for (std::size_t n = 0; n + 1 < levels.size(); n += stride) {
      const auto n_fast = sorted.end() - std::upper_bound(sorted.begin(), sorted.end(), levels[n]);
      const double work = work_of(step(levels[n]), own, static_cast<double>(n_fast));
      if (work < least) least = work, found = n;
    }
    if (found == levels.size()) return std::nullopt;
    return measured(levels[found]);
  }

 private:
  float stiffness(Index cell) const { return body_.solid->stiffness[static_cast<std::size_t>(cell)]; }
  double steps_of(double stable) const {
    return std::max(1.0, std::ceil(frame_ / (safety_ * stable) - 1e-9));
  }
  double stable(double omega2) const {
    return stable_step({omega2, body_.solid->beta * omega2}, Integrator::symplectic_euler);
  }
  double lagging(double stable) const { return std::min(stable, body_.solid->beta / (least_lag * safety_)); }
  double work_of(double rest, double own, double n_fast) const {
    const double n = static_cast<double>(cells_.size()), steps = steps_of(rest);
    const double substeps = std::ceil(frame_ / steps / own - 1e-9);
    return steps * (n + dearer * substeps * n_fast) / (uniform_steps_ * n);
  }

  Choice measured(float level) const {
    Choice choice;
    std::vector<std::uint8_t> soft(static_cast<std::size_t>(body_.capacity()), 0), stiff = soft;
    for (const Index cell : cells_) {
      const bool is_stiff = stiffness(cell) > level;
      (is_stiff ? stiff : soft)[static_cast<std::size_t>(cell)] = 1;
      if (is_stiff) choice.cells.push_back(cell);
    }
    choice.rest = lagging(stable(stiffest_mode_of_hexahedra(body_, soft).omega2));
    choice.own = safety_ * stable(stiffest_mode_of_hexahedra(body_, stiff).omega2);
    choice.n_cells = cells_.size();
    choice.work = work_of(choice.rest, choice.own, static_cast<double>(choice.cells.size()));
    choice.steps = steps_of(choice.rest);
    choice.substeps = std::ceil(frame_ / choice.steps / choice.own - 1e-9);
    return choice;
  }

  const Body& body_;
  double fastest_, frame_, safety_, uniform_steps_;
  std::vector<Index> cells_;
};

/// Has one of the cells a node at the surface that is free to move?
bool is_exposed(const Body& body, const std::vector<Index>& cells) {
  std::vector<std::uint8_t> around(static_cast<std::size_t>(body.capacity()), 0);
  for (const Index cell : body.nodes())
    if (body.solid->stiffness[static_cast<std::size_t>(cell)] > 0)
      for (const Index corner : corners_of_cell(body.lattice, cell))
        ++around[static_cast<std::size_t>(corner)];
  return std::ranges::any_of(cells, [&](Index cell) {
    return std::ranges::any_of(corners_of_cell(body.lattice, cell), [&](Index corner) {
      const auto c = static_cast<std::size_t>(corner);
      return around[c] < 8 && body.inverse_mass[c] > 0;
    });
  });
}

}  // namespace

double settle_step(const BodySpec& spec, Body& body, const Scene& scene, bool touched,
                   std::vector<std::string>& remarks) {
  const PhysicsSpec& physics = *scene.physics;
  const StiffestMode mode = stiffest_mode(body);
  if (body.mesh) body.mesh->model.fastest_omega2 = mode.omega2;
  const double all = stable_step(mode, physics.integrator);
  const bool may = body.solid && !is_awake_in_parts(body) && body.solid->beta > 0 &&
                   body.solid->relaxation.empty() && !may_change_for_good(body) &&
                   body.cell_net() == nullptr && physics.integrator == Integrator::symplectic_euler &&
                   physics.subcycle && !physics.step && std::isfinite(all);
  if (!may || physics.safety * all * physics.frame_Hz >= 1) return all;
  const std::optional<Choice> choice = Chooser(body, scene, mode.omega2, all).best();
  if (!choice || choice->work > most_of_the_work || choice->rest <= all) return all;
  const double uniform = std::ceil(1 / (physics.frame_Hz * physics.safety * all) - 1e-9);
  const std::string who = fmt::format("{}: body \"{}\"", spec.place.text(), spec.name);
  if (touched && is_exposed(body, choice->cells)) {
    remarks.push_back(
        fmt::format("{}: {} stiff cells of {} make {:g} steps a frame where the rest needs {:g}, and "
                    "something may touch "
                    "them; below the surface they would take steps of their own",
                    who, choice->cells.size(), choice->n_cells, uniform, choice->steps));
    return all;
  }
  remarks.push_back(fmt::format(
      "{}: {} stiff cells of {} take {:g} steps in each of {:g} steps a frame, which would be {:g} "
      "for all",
      who, choice->cells.size(), choice->n_cells, choice->substeps, choice->steps, uniform));
  body.solid->fast = {choice->cells, choice->own};
  return choice->rest;
}

}  // namespace palpate::physics
