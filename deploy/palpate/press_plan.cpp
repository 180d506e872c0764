#include "deploy/palpate/press_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "deploy/palpate/scene_draft.h"
#include "physics_node/body/body.h"
#include "physics_node/forecast/speed_forecast.h"
#include "physics_node/step/lattice/stable_step.h"

namespace palpate::deploy {
namespace {

using physics::Cells;

constexpr double press_to_tip =
    0.6;  // Why: 3 mm with a tip of 5 mm, felt, and shallow enough that cells keep their shape
constexpr double press_to_thickness = 0.25;  // Why: thinner tissue would be squeezed flat over what is rigid
constexpr double soft_modulus = 5e3, soft_density = 1000;  // [Pa, kg/m^3]
constexpr double viscosity_over_cell =
    150;  // [Pa s/m]. Why: swinging dies within some periods, and the step stays that of the modulus
constexpr int largest_radius = 10,
              smallest_radius =
                  4;  // [cells]. Why: five tips, and two, with which the rim errs by 3 % at most
constexpr double wanted_factor =
    1.25;  // of real time. Why: hand and eye want the other core, and a forecast is good to a factor of two
// Of a step with a tip on the faces of cells of half its radius, beside what the cells take, on one busy core: 0.07
// to 0.11 ms [s].
constexpr double contact_step_s = 1e-4;
constexpr double come_s = 1, press_s = 1, hold_s = 1, leave_s = 2;

/// Cells of tissue that are awake within so far of a cell, and their nodes: they wake in segments along x, whose ends lie anywhere.
struct Region {
  int cells = 0;
  double nodes = 0;
};
Region region_of(const Cells& cells, const Vec3i& middle, double within) {
  Region region;
  std::set<std::array<int, 3>> nodes;
  const Vec3i reach = (within / cells.spacing.array()).ceil().cast<int>();
  for (int k = middle.z() - reach.z(); k <= middle.z() + reach.z(); ++k)
    for (int j = middle.y() - reach.y(); j <= middle.y() + reach.y(); ++j) {
      const double aside =
          std::hypot(cells.spacing.y() * (j - middle.y()), cells.spacing.z() * (k - middle.z()));
      if (aside >= within) continue;
      const double along = std::sqrt(within * within - aside * aside) / cells.spacing.x();
      const int half = static_cast<int>(std::ceil(along)) + physics::row_segment;
      for (int i = middle.x() - half; i <= middle.x() + half; ++i) {
        if (!cells.is_filled(i, j, k)) continue;
        ++region.cells;
        for (int c = 0; c < 8; ++c) nodes.insert({i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)});
      }
    }
  region.nodes = static_cast<double>(nodes.size());
  return region;
}

MaterialSpec soft_tissue(const Cells& cells) {
  MaterialSpec soft;
  soft.name = "soft";
  soft.modulus = soft_modulus;
  soft.density = soft_density;
  soft.viscosity_bulk = viscosity_over_cell * cells.spacing.minCoeff();
  return soft;
}

/// What the step and the speed go by: a block of a few of the cells, as narrow as they are at the narrowest.
class Pace {
 public:
  Pace(const MaterialSpec& soft, double edge) {
    BodySpec block;
    block.name = "tissue";
    block.lattice = LatticeKind::voxel;
    block.model = ElementModel::fem;
    block.shape = BoxShape{Vec3::Constant(4 * edge)};
    block.spacing = edge;
    block.material = soft.name;
    scene_.materials = {soft};
    scene_.bodies = {block};
    scene_.physics->safety = step_safety;
    step_ = physics::stable_step(physics::stiffest_mode(physics::build_body(block, soft)),
                                 scene_.physics->integrator);
  }
  /// Times real time while the tip presses so many nodes.
  double factor(double nodes) const {
    const auto free = physics::forecast_speed(scene_, std::array{nodes}, step_);
    return 1 / (1 / free.real_time_factor + scene_.physics->frame_Hz * free.steps_a_frame * contact_step_s);
  }

 private:
  Scene scene_;
  double step_ = 0;
};

std::vector<Waypoint> path_of(const TouchPlace& place, double tip_radius, double depth) {
  const Vec3 outside = place.at + approach_length(tip_radius) * place.outward;
  const Vec3 inside = place.at - depth * place.outward;
  std::vector<Waypoint> path = {{0, outside}};
  for (const auto& [lasts, at] : {std::pair(come_s, place.at), std::pair(press_s, inside),
                                  std::pair(hold_s, inside), std::pair(leave_s, outside)})
    path.push_back({path.back().t + lasts, at});
  return path;
}

/// A tenth of the tissue, or a cell, on the side of the image that the finger presses towards.
Eigen::AlignedBox3d opposite(const Cells& cells, const TouchPlace& place) {
  Eigen::Index axis = 0;
  place.outward.cwiseAbs().maxCoeff(&axis);
  Vec3i lo = cells.size, hi = Vec3i::Constant(-1);
  for (int k = 0; k < cells.size.z(); ++k)
    for (int j = 0; j < cells.size.y(); ++j)
      for (int i = 0; i < cells.size.x(); ++i)
        if (cells.is_filled(i, j, k)) lo = lo.cwiseMin(Vec3i(i, j, k)), hi = hi.cwiseMax(Vec3i(i, j, k));
  const int depth = std::max(1, (hi[axis] - lo[axis] + 1) / 10);
  (place.outward[axis] > 0 ? hi[axis] : lo[axis]) =
      place.outward[axis] > 0 ? lo[axis] + depth - 1 : hi[axis] - depth + 1;
  const auto corner = [&](const Vec3i& cell) {
    return Vec3(cells.corner + cells.spacing.cwiseProduct(cell.cast<double>()));
  };
  const Vec3 slack = 0.25 * cells.spacing;  // Why: nodes at its border are in it
  return {corner(lo) - slack, corner(hi + Vec3i::Ones()) + slack};
}

}  // namespace

PressPlan plan_press(const ImageTissue& tissue, const TouchPlace& place, const std::string& path) {
  const Cells& cells = tissue.cells;
  PressPlan plan;
  plan.material = soft_tissue(cells);
  plan.depth = std::min(press_to_tip * tissue.tip_radius, press_to_thickness * place.thickness);
  plan.path = path_of(place, tissue.tip_radius, plan.depth);
  plan.held = opposite(cells, place);
  const Pace pace(plan.material, cells.spacing.minCoeff());
  const auto all = static_cast<int>(cells.n_filled());
  for (int radius = largest_radius; radius >= smallest_radius; --radius) {
    const double awake = radius * cells.spacing.minCoeff();
    const Region region = region_of(cells, place.cell, awake);
    if (region.cells >= all) continue;  // Why: nothing would hold it
    plan.awake = awake;
    plan.n_awake = region.cells;
    plan.real_time_factor = pace.factor(region.nodes);
    if (plan.real_time_factor >= wanted_factor) return plan;
  }
  if (plan.awake > 0) return plan;
  throw InputError(
      fmt::format("{}: its tissue, of {:.3g} x {:.3g} x {:.3g} mm cells, is hardly larger than the tip, and "
                  "nothing would "
                  "hold it; give another --keep lowest,highest, or import the image with a finer --partition",
                  path, 1e3 * cells.spacing.x(), 1e3 * cells.spacing.y(), 1e3 * cells.spacing.z()));
}

}  // namespace palpate::deploy
