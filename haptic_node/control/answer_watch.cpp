#include "haptic_node/control/answer_watch.h"

#include <algorithm>
#include <cmath>

#include "common/time/clock.h"
#include "haptic_node/tissue/tissue_model.h"

namespace palpate::haptic {
namespace {

constexpr double unit_tolerance = 1e-3;

bool within(const Array3& a, double limit) noexcept {
  return std::all_of(a.begin(), a.end(), [limit](double value) { return std::abs(value) <= limit; });
}

template <class Array>
bool is_unit(const Array& a) noexcept {
  double squared = 0;
  for (const double value : a) squared += value * value;
  return std::abs(std::sqrt(squared) - 1.0) <= unit_tolerance;
}

bool facet_is_sound(const PatchFacet& facet) noexcept {
  for (const Array3& corner : facet.corners)
    if (!within(corner, farthest_hand)) return false;
  if (!within(facet.point, farthest_hand) || !within(facet.velocity, farthest_hand)) return false;
  if (!is_unit(facet.normal)) return false;
  return facet.stiffness > 0 && facet.stiffness <= rigid_stiffness && facet.damping >= 0 &&
         facet.damping <= rigid_stiffness;
}

}  // namespace

bool is_sound(const ContactPatch& patch, std::uint32_t tool) noexcept {
  if (patch.tool != tool || patch.n_facets > max_patch_facets) return false;
  return std::all_of(patch.facets.begin(), patch.facets.begin() + patch.n_facets, facet_is_sound);
}

bool is_sound(const ToolWrench& wrench, std::uint32_t tool) noexcept {
  if (wrench.tool != tool || !within(wrench.p_WT, farthest_hand) || !within(wrench.set_point, farthest_hand))
    return false;
  if (!within(wrench.force, strongest_tissue) || !within(wrench.moment, strongest_tissue)) return false;
  for (const double k : wrench.stiffness)
    if (!(std::abs(k) <= rigid_stiffness)) return false;
  if (!within(wrench.tip, farthest_hand) || !(std::abs(wrench.stretch) <= farthest_hand)) return false;
  return is_unit(wrench.q_WT) && (wrench.normal == Array3{} || is_unit(wrench.normal));
}

template <class Answer>
bool AnswerWatch<Answer>::accept(const Answer* answer, std::int64_t now_ns) noexcept {
  if (answer == nullptr || (seen_ && answer->tick == seen_tick_)) return false;
  seen_ = true;
  seen_tick_ = answer->tick;
  if (!is_sound(*answer, tool_)) {
    ++rejected_;
    return false;
  }
  const bool any_tick = !ever_ || anew_ || silence(now_ns) > patience();
  if (!any_tick && answer->tick > tick_ && answer->tick - tick_ > most_ahead) {
    ++rejected_;
    return false;
  }
  if (!any_tick && answer->tick <= tick_) return false;
  anew_ = false;
  if (ever_) {
    const double apart = std::clamp(silence(now_ns), 1e-4, 0.1);
    period_ += (apart > period_ ? 0.3 : 0.1) * (apart - period_);
  }
  ever_ = true;
  tick_ = answer->tick;
  accepted_ns_ = now_ns;
  ++taken_;
  return true;
}

template <class Answer>
double AnswerWatch<Answer>::silence(std::int64_t now_ns) const noexcept {
  return seconds_from_ns(now_ns - accepted_ns_);
}

template <class Answer>
double AnswerWatch<Answer>::patience() const noexcept {
  return std::clamp(3.0 * period_, 0.12, 0.2);
}

template <class Answer>
double AnswerWatch<Answer>::gain(std::int64_t now_ns) const noexcept {
  if (!ever_) return 0.0;
  const double s = std::clamp((silence(now_ns) - patience()) / fade_time, 0.0, 1.0);
  return 1.0 - s * s;
}

template class AnswerWatch<ContactPatch>;
template class AnswerWatch<ToolWrench>;
template class AnswerWatch<TissueAnswer>;

}  // namespace palpate::haptic
