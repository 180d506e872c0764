#include "bench/haptic/rubbish.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bench/haptic/tissue.h"
#include "haptic_node/control/controller.h"

namespace palpate::bench {

double Rubbish::number() {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const double odd[] = {std::numeric_limits<double>::quiet_NaN(), inf, -inf, 1e30, -1e-300, 0.0};
  const std::uint32_t kind = pick(9);
  return kind < 6 ? odd[kind] : 0.1 * (static_cast<double>(pick(2001)) / 1000 - 1);
}

void Rubbish::spoil(PatchFacet& facet) {
  double* const fields[] = {&facet.corners[1][2], &facet.point[0],  &facet.normal[1],
                            &facet.velocity[2],   &facet.stiffness, &facet.damping};
  *fields[pick(6)] = number();
}

/// Of any time: now, long ago, far ahead, and what overflows where it is subtracted.
std::int64_t Rubbish::stamp() {
  constexpr std::int64_t now = 1'000'000'000, century = 3'000'000'000'000'000'000;
  const std::int64_t odd[] = {0,
                              -now,
                              now - century,
                              century,
                              std::numeric_limits<std::int64_t>::min(),
                              std::numeric_limits<std::int64_t>::max()};
  const std::uint32_t kind = pick(9);
  return kind < 6 ? odd[kind] : now + pick(1'000'000'000);
}

ContactPatch Rubbish::patch() {
  ContactPatch patch = flat_square(random_(), 0, 0, pick(2) == 0 ? rigid_stiffness : 300);
  patch.stamp_ns = stamp();
  patch.answers = random_();
  patch.answers_ns = stamp();
  patch.contact_set = pick(3);
  patch.n_facets = pick(4) == 0 ? static_cast<std::uint32_t>(random_()) : pick(3);
  const std::uint32_t spoilt = pick(4);
  for (std::uint32_t i = 0; i < spoilt; ++i) spoil(patch.facets[pick(2)]);
  if (pick(20) == 0) patch.tool = pick(3);
  return patch;
}

ToolWrench Rubbish::wrench() {
  ToolWrench wrench;
  wrench.tick = random_();
  wrench.stamp_ns = stamp();
  wrench.answers = random_();
  wrench.answers_ns = stamp();
  wrench.force = {0, 0, 2e-3 * pick(1000)};
  wrench.moment = {1e-5 * pick(1000), 0, 0};
  for (const std::size_t k : {0U, 1U, 2U}) wrench.stiffness[7 * k] = pick(2) == 0 ? 1e6 : 300;
  for (const std::size_t k : {3U, 4U, 5U}) wrench.stiffness[7 * k] = 0.01 * pick(100);
  double* const fields[] = {&wrench.p_WT[1],       &wrench.q_WT[0],      &wrench.q_WT[2],
                            &wrench.force[0],      &wrench.force[2],     &wrench.moment[1],
                            &wrench.set_point[2],  &wrench.tip[0],       &wrench.t,
                            &wrench.stiffness[14], &wrench.stiffness[3], &wrench.stiffness[35]};
  const std::uint32_t spoilt = pick(3);
  for (std::uint32_t i = 0; i < spoilt; ++i) *fields[pick(12)] = number();
  if (pick(20) == 0) wrench.tool = pick(3);
  return wrench;
}

namespace {

/// Of a stream: is what is taken newer than what was, and of this tool?
class Gatekeeper {
 public:
  template <class Answer>
  bool wrongly(const Answer& answer, std::int64_t now_ns) {
    const bool wrong = answer.tool != 0 || (answer.tick <= tick_ && now_ns - taken_ns_ < 120'000'000);
    tick_ = answer.tick;
    taken_ns_ = now_ns;
    return wrong;
  }

 private:
  std::uint64_t tick_ = 0;
  std::int64_t taken_ns_ = 0;
};

haptic::ControllerSettings settings_of(ForceModel model) {
  haptic::ControllerSettings settings;
  settings.model = model;
  if (model == ForceModel::tangent) settings.torque_limit = 0.02;
  return settings;
}

}  // namespace

RubbishResult feed_rubbish(std::size_t ticks, ForceModel model, std::uint64_t seed) {
  const haptic::ControllerSettings settings = settings_of(model);
  haptic::Controller controller(settings);
  controller.set_state(haptic::HapticState::ready);
  const bool planes = model != ForceModel::tangent;
  const auto taken = [&] { return planes ? controller.patches().taken() : controller.wrenches().taken(); };
  Rubbish rubbish(seed);
  Gatekeeper keeper;
  RubbishResult result;
  result.fed = ticks;
  result.limit = controller.force_limit();
  haptic::DeviceSample sample;
  sample.has_new = sample.powered = true;
  std::int64_t now = 1'000'000'000;
  for (std::size_t i = 0; i < ticks; ++i) {
    now += 1'000'000;
    sample.t_ns = now;
    sample.x = {0.01 * std::sin(1e-3 * static_cast<double>(i)), 0,
                0.01 * std::cos(2e-3 * static_cast<double>(i))};
    ContactPatch patch = rubbish.patch();
    ToolWrench wrench = rubbish.wrench();
    // Every other tick must be newer than the last, or nothing would ever be taken. Some are old, the others anything.
    if (i % 2 == 0) patch.tick = wrench.tick = i + 1;
    if (i % 8 == 1) patch.tick = wrench.tick = i / 2;
    const std::uint64_t before = taken();
    const haptic::ControllerOutput out = controller.tick(now, sample, &patch, &wrench);
    if (taken() != before)
      result.wrongly_taken += planes ? keeper.wrongly(patch, now) : keeper.wrongly(wrench, now);
    const double most = 1 + 1e-12;
    result.bad_forces += !out.force.allFinite() || out.force.norm() > result.limit * most ||
                         !out.torque.allFinite() || out.torque.norm() > settings.torque_limit * most;
    if (out.force.allFinite()) result.force_most = std::max(result.force_most, out.force.norm());
  }
  result.rejected = planes ? controller.patches().rejected() : controller.wrenches().rejected();
  result.taken = taken();
  return result;
}

}  // namespace palpate::bench
