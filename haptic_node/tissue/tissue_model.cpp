#include "haptic_node/tissue/tissue_model.h"

#include <cmath>

#include "haptic_node/tissue/tissue_bounds.h"

namespace palpate::haptic {
namespace {

constexpr double of_length_1 = 1e-6;

}  // namespace

bool is_sound(const TissueAnswer& answer, std::uint32_t tool) noexcept {
  const TissueModel& m = answer.model;
  const TissueState& s = answer.state;
  if (answer.tool != tool || m.n_modes > TissueModel::most_modes || m.n_branches > TissueModel::most_branches)
    return false;
  if (!within(m.normal.squaredNorm(), 1 - of_length_1, 1 + of_length_1)) return false;
  for (std::uint32_t i = 0; i < m.n_modes; ++i) {
    if (!within(m.modes[i].psi, largest_shape)) return false;
    if (!within(m.modes[i].stiffness, 0, stiffest_mode)) return false;
    if (!within(m.modes[i].damping, 0, most_mode_damping)) return false;
    if (!within(s.q[i], largest_state) || !within(s.w[i], largest_state)) return false;
  }
  for (std::uint32_t j = 0; j < m.n_branches; ++j) {
    if (!within(m.branches[j].stiffness, 0, rigid_stiffness)) return false;
    if (!(m.branches[j].time > 0) || !std::isfinite(m.branches[j].time)) return false;
    if (!within(m.branches[j].share, 0, most_flow)) return false;
    if (!within(s.p[j], farthest_hand) || !within(s.f[j], 0, strongest_tissue)) return false;
  }
  return within(answer.arm, farthest_hand) && within(m.friction, 0, largest_friction) &&
         within(m.residual, 0, most_compliance) && within(m.residual_across, 0, most_compliance) &&
         within(m.growth, 0, most_growth) && within(s.rest, farthest_hand) &&
         within(s.force, strongest_tissue) && pressed(m, s) >= 0;
}

}  // namespace palpate::haptic
