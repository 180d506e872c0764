// One broken promise at a time, and the reason that must be named.

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "common/wire/convert.h"
#include "common/wire/topic.h"
#include "tests/unit/common/wire/sample_messages.h"

namespace palpate {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr float nan_f = std::numeric_limits<float>::quiet_NaN();
using R = RejectReason;

template <class M>
struct Case {
  const char* what;
  R reason;
  std::function<void(typename Topic<M>::Wire&)> breaks;
};

/// A whole sample with all arrays full, so that every element counts.
template <class M>
M full() {
  return test::random_message<M>(11);
}
template <>
ContactPatch full<ContactPatch>() {
  for (std::uint64_t seed = 1;; ++seed) {
    const auto patch = test::random_message<ContactPatch>(seed);
    if (patch.n_facets == max_patch_facets) return patch;
  }
}
template <>
HapticTrace full<HapticTrace>() {
  for (std::uint64_t seed = 1;; ++seed) {
    const auto trace = test::random_message<HapticTrace>(seed);
    if (trace.n_samples == max_trace_samples) return trace;
  }
}

template <class M>
void expect_all_rejected(const std::vector<Case<M>>& cases) {
  const auto wire = std::make_unique<typename Topic<M>::Wire>();
  const auto message = std::make_unique<M>(full<M>());
  const auto untouched = std::make_unique<M>();
  for (const auto& one : cases) {
    to_wire(*message, *wire);
    ASSERT_FALSE(judge(*wire)) << "the sample to be broken must be whole";
    one.breaks(*wire);
    EXPECT_EQ(from_wire(*wire, *untouched), one.reason) << one.what;
    EXPECT_TRUE(*untouched == M{}) << one.what << " was let through in part";
  }
}

TEST(MalformedToolState, IsRejectedForItsReason) {
  expect_all_rejected<ToolState>({
      {"other version", R::version, [](auto& w) { w.version = wire_version + 1; }},
      {"tool beyond the last", R::unknown_id, [](auto& w) { w.tool = max_tools; }},
      {"NaN position", R::not_finite, [](auto& w) { w.p_WT[2] = nan; }},
      {"infinite velocity", R::not_finite, [](auto& w) { w.v_WT[0] = inf; }},
      {"NaN angular velocity", R::not_finite, [](auto& w) { w.w_WT[1] = nan; }},
      {"NaN proxy", R::not_finite, [](auto& w) { w.proxy[0] = nan; }},
      {"infinite force", R::not_finite, [](auto& w) { w.force_on_hand[2] = -inf; }},
      {"NaN force now", R::not_finite, [](auto& w) { w.force_now[0] = nan; }},
      {"infinite torque", R::not_finite, [](auto& w) { w.torque_now[1] = inf; }},
      {"NaN attitude", R::not_finite, [](auto& w) { w.q_WT[0] = nan; }},
      {"attitude of length 1.01", R::not_unit,
       [](auto& w) {
         for (double& q : w.q_WT) q *= 1.01;
       }},
      {"attitude zero", R::not_unit,
       [](auto& w) {
         for (double& q : w.q_WT) q = 0;
       }},
      {"engaged neither 0 nor 1", R::out_of_range, [](auto& w) { w.engaged = 2; }},
      {"a hand on the moon", R::out_of_range, [](auto& w) { w.p_WT[2] = 4e8; }},
      {"a proxy 2 km down", R::out_of_range, [](auto& w) { w.proxy[2] = -2e3; }},
      {"faster than any hand", R::out_of_range, [](auto& w) { w.v_WT[1] = 1e30; }},
      {"turns faster than any hand", R::out_of_range, [](auto& w) { w.w_WT[0] = -1e30; }},
      {"force of no device", R::out_of_range, [](auto& w) { w.force_on_hand[0] = 1e200; }},
      {"force now of no device", R::out_of_range, [](auto& w) { w.force_now[1] = -2e3; }},
      {"torque of no device", R::out_of_range, [](auto& w) { w.torque_now[2] = 2e3; }},
      {"a stamp that no difference may be taken of", R::out_of_range,
       [](auto& w) { w.stamp_ns = std::numeric_limits<std::int64_t>::min(); }},
  });
}

TEST(MalformedContactPatch, IsRejectedForItsReason) {
  expect_all_rejected<ContactPatch>({
      {"other version", R::version, [](auto& w) { w.version = wire_version + 1; }},
      {"tool beyond the last", R::unknown_id, [](auto& w) { w.tool = 4000000000U; }},
      {"one facet too many", R::count, [](auto& w) { w.n_facets = max_patch_facets + 1; }},
      {"four thousand million facets", R::count, [](auto& w) { w.n_facets = 0xffffffffU; }},
      {"NaN corner", R::not_finite, [](auto& w) { w.facets[0].corners[2][1] = nan; }},
      {"NaN point in the last facet", R::not_finite, [](auto& w) { w.facets[15].point[0] = nan; }},
      {"infinite velocity", R::not_finite, [](auto& w) { w.facets[3].velocity[1] = inf; }},
      {"NaN normal", R::not_finite, [](auto& w) { w.facets[1].normal[0] = nan; }},
      {"NaN stiffness", R::not_finite, [](auto& w) { w.facets[1].stiffness = nan; }},
      {"infinite damping", R::not_finite, [](auto& w) { w.facets[1].damping = inf; }},
      {"normal of length 1.002", R::not_unit,
       [](auto& w) {
         for (double& n : w.facets[5].normal) n *= 1.002;
       }},
      {"stiffness zero", R::out_of_range, [](auto& w) { w.facets[2].stiffness = 0; }},
      {"stiffness negative", R::out_of_range, [](auto& w) { w.facets[2].stiffness = -100; }},
      {"stiffer than rigid", R::out_of_range, [](auto& w) { w.facets[2].stiffness = 2 * rigid_stiffness; }},
      {"damping negative", R::out_of_range, [](auto& w) { w.facets[2].damping = -1e-9; }},
      {"body beyond the last", R::unknown_id, [](auto& w) { w.facets[2].body = max_bodies; }},
      {"corner on the moon", R::out_of_range, [](auto& w) { w.facets[0].corners[1][0] = 4e8; }},
      {"plane on the moon", R::out_of_range, [](auto& w) { w.facets[0].point[2] = -4e8; }},
      {"faster than any tissue", R::out_of_range, [](auto& w) { w.facets[4].velocity[2] = 1e30; }},
      {"damped beyond rigid", R::out_of_range, [](auto& w) { w.facets[4].damping = 1e300; }},
      {"an answer to a time without end", R::out_of_range,
       [](auto& w) { w.answers_ns = std::numeric_limits<std::int64_t>::max(); }},
  });
}

TEST(MalformedToolWrench, IsRejectedForItsReason) {
  expect_all_rejected<ToolWrench>({
      {"other version", R::version, [](auto& w) { w.version = wire_version + 1; }},
      {"tool beyond the last", R::unknown_id, [](auto& w) { w.tool = max_tools; }},
      {"NaN time", R::not_finite, [](auto& w) { w.t = nan; }},
      {"NaN force", R::not_finite, [](auto& w) { w.force[0] = nan; }},
      {"infinite moment", R::not_finite, [](auto& w) { w.moment[2] = inf; }},
      {"NaN set point", R::not_finite, [](auto& w) { w.set_point[1] = nan; }},
      {"NaN in the last stiffness", R::not_finite, [](auto& w) { w.stiffness[35] = nan; }},
      {"infinite pose", R::not_finite, [](auto& w) { w.p_WT[0] = inf; }},
      {"NaN attitude", R::not_finite, [](auto& w) { w.q_WT[2] = nan; }},
      {"attitude of length 2", R::not_unit,
       [](auto& w) {
         for (double& q : w.q_WT) q *= 2;
       }},
      {"NaN tip", R::not_finite, [](auto& w) { w.tip[1] = nan; }},
      {"NaN normal", R::not_finite, [](auto& w) { w.normal[0] = nan; }},
      {"infinite stretch", R::not_finite, [](auto& w) { w.stretch = inf; }},
      {"time of 1e300 s", R::out_of_range, [](auto& w) { w.t = 1e300; }},
      {"time of 1e17 s", R::out_of_range, [](auto& w) { w.t = 1e17; }},
      {"time before the start", R::out_of_range, [](auto& w) { w.t = -1e-3; }},
      {"force of no tissue", R::out_of_range, [](auto& w) { w.force[1] = 1e7; }},
      {"moment of no tissue", R::out_of_range, [](auto& w) { w.moment[1] = 1e7; }},
      {"tip on the moon", R::out_of_range, [](auto& w) { w.tip[0] = 4e8; }},
      {"set point on the moon", R::out_of_range, [](auto& w) { w.set_point[0] = 4e8; }},
      {"a hand on the moon", R::out_of_range, [](auto& w) { w.p_WT[0] = 4e8; }},
      {"stiffer than rigid", R::out_of_range, [](auto& w) { w.stiffness[7] = 1e10; }},
      {"stretched to the moon", R::out_of_range, [](auto& w) { w.stretch = 4e8; }},
      {"a stamp that no difference may be taken of", R::out_of_range,
       [](auto& w) { w.stamp_ns = std::numeric_limits<std::int64_t>::min(); }},
      {"normal neither unit nor zero", R::not_unit,
       [](auto& w) {
         w.normal[0] = w.normal[1] = 0;
         w.normal[2] = 0.5;
       }},
  });
}

TEST(MalformedBodySurface, IsRejectedForItsReason) {
  expect_all_rejected<BodySurface>({
      {"other version", R::version, [](auto& w) { w.version = wire_version + 1; }},
      {"body beyond the last", R::unknown_id, [](auto& w) { w.body = max_bodies; }},
      {"too many vertices", R::count, [](auto& w) { w.n_vertices = max_surface_vertices + 1; }},
      {"too many facets", R::count, [](auto& w) { w.n_facets = 0x80000000U; }},
      {"chunk not below the number of chunks", R::count, [](auto& w) { w.chunk = w.n_chunks; }},
      {"no chunks", R::count, [](auto& w) { w.n_chunks = 0; }},
      {"absurdly many chunks", R::count, [](auto& w) { w.n_chunks = max_surface_chunks + 1; }},
      {"more vertices than the chunks can hold", R::count,
       [](auto& w) { w.total_vertices = w.n_chunks * max_surface_vertices + 1; }},
      {"more facets than the chunks can hold", R::count, [](auto& w) { w.total_facets = 0xffffffffU; }},
      {"vertices beyond the total", R::out_of_range, [](auto& w) { w.first_vertex = w.total_vertices; }},
      {"vertices whose sum wraps round", R::out_of_range, [](auto& w) { w.first_vertex = 0xffffffffU; }},
      {"facets beyond the total", R::out_of_range,
       [](auto& w) { w.first_facet = w.total_facets - w.n_facets + 1; }},
      {"revision zero", R::out_of_range, [](auto& w) { w.revision = 0; }},
      {"rigid neither 0 nor 1", R::out_of_range, [](auto& w) { w.rigid = 255; }},
      {"NaN position", R::not_finite, [](auto& w) { w.position[w.n_vertices - 1][2] = nan_f; }},
      {"vertex that no float may square", R::out_of_range,
       [](auto& w) { w.position[w.n_vertices - 1][1] = 1e30F; }},
      {"corner that is no vertex", R::unknown_id,
       [](auto& w) { w.corners[w.n_facets - 1][3] = w.total_vertices; }},
  });
}

TEST(MalformedSurfaceChange, IsRejectedForItsReason) {
  expect_all_rejected<SurfaceChange>({
      {"other version", R::version, [](auto& w) { w.version = wire_version + 1; }},
      {"body beyond the last", R::unknown_id, [](auto& w) { w.body = max_bodies; }},
      {"too many vertices", R::count, [](auto& w) { w.n_vertices = max_change_vertices + 1; }},
      {"too many changes", R::count, [](auto& w) { w.n_changes = 0x80000000U; }},
      {"page beyond the last", R::count, [](auto& w) { w.page = max_change_pages; }},
      {"more vertices than any surface has", R::count, [](auto& w) { w.total_vertices = 0xffffffffU; }},
      {"more facets than any surface has", R::count,
       [](auto& w) { w.total_facets = max_surface_chunks * max_surface_facets + 1; }},
      {"more changes than the pages can hold", R::count,
       [](auto& w) { w.total_changes = max_change_pages * max_change_facets + 1; }},
      {"vertices beyond the total", R::out_of_range, [](auto& w) { w.first_vertex = w.total_vertices; }},
      {"vertices whose sum wraps round", R::out_of_range, [](auto& w) { w.first_vertex = 0xffffffffU; }},
      {"changes beyond the total", R::out_of_range,
       [](auto& w) { w.first_change = w.total_changes - w.n_changes + 1; }},
      {"revision zero", R::out_of_range, [](auto& w) { w.revision = 0; }},
      {"change zero", R::out_of_range, [](auto& w) { w.change = 0; }},
      {"NaN position", R::not_finite, [](auto& w) { w.position[w.n_vertices - 1][2] = nan_f; }},
      {"vertex that no float may square", R::out_of_range,
       [](auto& w) { w.position[w.n_vertices - 1][1] = 1e30F; }},
      {"facet of no surface", R::unknown_id,
       [](auto& w) { w.facets[w.n_changes - 1].facet = max_surface_chunks * max_surface_facets; }},
      {"corner that is no vertex", R::unknown_id,
       [](auto& w) { w.facets[w.n_changes - 1].corners[3] = w.total_vertices; }},
  });
}

TEST(MalformedVertexBlock, IsRejectedForItsReason) {
  expect_all_rejected<VertexBlock>({
      {"other version", R::version, [](auto& w) { w.version = wire_version + 1; }},
      {"body beyond the last", R::unknown_id, [](auto& w) { w.body = max_bodies; }},
      {"too many vertices", R::count, [](auto& w) { w.n_vertices = max_block_vertices + 1; }},
      {"block that does not fit its first vertex", R::out_of_range, [](auto& w) { w.block += 1; }},
      {"vertices beyond any surface", R::out_of_range,
       [](auto& w) { w.first_vertex = 0xfffff800U, w.block = w.first_vertex / max_block_vertices; }},
      {"revision zero", R::out_of_range, [](auto& w) { w.revision = 0; }},
      {"NaN time", R::not_finite, [](auto& w) { w.t = nan; }},
      {"NaN position", R::not_finite, [](auto& w) { w.position[w.n_vertices - 1][0] = nan_f; }},
      {"time of 1e300 s", R::out_of_range, [](auto& w) { w.t = 1e300; }},
      {"vertex that no float may square", R::out_of_range,
       [](auto& w) { w.position[w.n_vertices - 1][1] = -1e30F; }},
      {"time before the start", R::out_of_range, [](auto& w) { w.t = -1e-3; }},
      {"a share of nothing that yielded", R::out_of_range, [](auto& w) { w.flags[w.n_vertices - 1] = 4; }},
  });
}

TEST(MalformedHapticTrace, IsRejectedForItsReason) {
  expect_all_rejected<HapticTrace>({
      {"other version", R::version, [](auto& w) { w.version = wire_version + 1; }},
      {"tool beyond the last", R::unknown_id, [](auto& w) { w.tool = max_tools; }},
      {"one sample too many", R::count, [](auto& w) { w.n_samples = max_trace_samples + 1; }},
      {"NaN time", R::not_finite, [](auto& w) { w.samples[0].t = nan; }},
      {"NaN position", R::not_finite, [](auto& w) { w.samples[63].p[0] = nan; }},
      {"NaN proxy", R::not_finite, [](auto& w) { w.samples[9].proxy[1] = nan; }},
      {"infinite force", R::not_finite, [](auto& w) { w.samples[9].force[1] = inf; }},
      {"NaN torque", R::not_finite, [](auto& w) { w.samples[9].torque[0] = nan; }},
      {"NaN energy", R::not_finite, [](auto& w) { w.samples[9].energy = nan; }},
      {"time of 1e300 s", R::out_of_range, [](auto& w) { w.samples[63].t = 1e300; }},
      {"time of 1e17 s", R::out_of_range, [](auto& w) { w.samples[0].t = 1e17; }},
      {"time before the start", R::out_of_range, [](auto& w) { w.samples[3].t = -1e-3; }},
      {"a hand on the moon", R::out_of_range, [](auto& w) { w.samples[9].p[2] = 4e8; }},
      {"a proxy on the moon", R::out_of_range, [](auto& w) { w.samples[9].proxy[2] = 4e8; }},
      {"force of no device", R::out_of_range, [](auto& w) { w.samples[9].force[2] = 1e200; }},
      {"torque of no device", R::out_of_range, [](auto& w) { w.samples[9].torque[2] = 1e200; }},
      {"energy of no hand", R::out_of_range, [](auto& w) { w.samples[9].energy = -1e200; }},
      {"samples out of order", R::other, [](auto& w) { w.samples[9].tick = w.samples[8].tick; }},
  });
}

TEST(MalformedPointer, IsRejectedForItsReason) {
  expect_all_rejected<Pointer>({
      {"other version", R::version, [](auto& w) { w.version = wire_version - 1; }},
      {"tool beyond the last", R::unknown_id, [](auto& w) { w.tool = max_tools; }},
      {"NaN position", R::not_finite, [](auto& w) { w.p_W[1] = nan; }},
      {"infinite attitude", R::not_finite, [](auto& w) { w.q_W[3] = inf; }},
      {"attitude of length 0.9", R::not_unit,
       [](auto& w) {
         for (double& q : w.q_W) q *= 0.9;
       }},
      {"a mouse on the moon", R::out_of_range, [](auto& w) { w.p_W[0] = 4e8; }},
      {"held neither 0 nor 1", R::out_of_range, [](auto& w) { w.held = 2; }},
  });
}

TEST(MalformedCommand, IsRejectedForItsReason) {
  expect_all_rejected<Command>({
      {"other version", R::version, [](auto& w) { w.version = wire_version + 1; }},
      {"unknown kind", R::unknown_id, [](auto& w) { w.kind = n_command_kinds; }},
      {"NaN value", R::not_finite, [](auto& w) { w.value = nan; }},
      {"threshold of 1e300", R::out_of_range, [](auto& w) { w.value = 1e300; }},
      {"name without end", R::text, [](auto& w) { std::memset(w.name, 'a', sizeof w.name); }},
  });
}

TEST(MalformedNodeStatus, IsRejectedForItsReason) {
  expect_all_rejected<NodeStatus>({
      {"other version", R::version, [](auto& w) { w.version = wire_version + 1; }},
      {"unknown node", R::unknown_id, [](auto& w) { w.node = n_node_kinds; }},
      {"unknown phase", R::out_of_range, [](auto& w) { w.phase = n_node_phases; }},
      {"NaN time", R::not_finite, [](auto& w) { w.t = nan; }},
      {"infinite rate", R::not_finite, [](auto& w) { w.rate_Hz = inf; }},
      {"NaN real-time factor", R::not_finite, [](auto& w) { w.real_time_factor = nan; }},
      {"NaN energy", R::not_finite, [](auto& w) { w.energy_J = nan; }},
      {"infinite surplus", R::not_finite, [](auto& w) { w.surplus_J = -inf; }},
      {"NaN loop age", R::not_finite, [](auto& w) { w.loop_age_ms_p50 = nan; }},
      {"negative time", R::out_of_range, [](auto& w) { w.t = -1; }},
      {"negative rate", R::out_of_range, [](auto& w) { w.rate_Hz = -1; }},
      {"time of 1e300 s", R::out_of_range, [](auto& w) { w.t = 1e300; }},
      {"rate of 1e300 Hz", R::out_of_range, [](auto& w) { w.rate_Hz = 1e300; }},
      {"energy of no hand", R::out_of_range, [](auto& w) { w.energy_J = -1e30; }},
      {"refusal without end", R::text, [](auto& w) { std::memset(w.refused, 'x', sizeof w.refused); }},
      {"note without end", R::text, [](auto& w) { std::memset(w.note, 'x', sizeof w.note); }},
  });
}

}  // namespace
}  // namespace palpate
