#pragma once
// Messages with random content that keeps all promises, and their fields one by one.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <tuple>

#include "common/message/messages.h"

namespace palpate::test {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  std::uint64_t integer() { return engine_(); }
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(engine_() % n); }
  double real(double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  template <class T, std::size_t N>
  void fill(std::array<T, N>& values) {
    for (T& value : values) fill(value);
  }
  void fill(double& value) { value = real(-10, 10); }
  void fill(float& value) { value = static_cast<float>(real(-10, 10)); }
  void fill(std::uint64_t& value) { value = integer(); }
  void fill(std::int64_t& value) { value = static_cast<std::int64_t>(integer() >> 3); }
  void fill(std::uint32_t& value) { value = static_cast<std::uint32_t>(integer()); }
  template <std::size_t N>
  void fill_unit(std::array<double, N>& values) {
    double squared = 0;
    fill(values);
    for (const double value : values) squared += value * value;
    for (double& value : values) value /= std::sqrt(squared);
  }
  template <std::size_t N>
  void fill_text(std::array<char, N>& text) {
    const auto length = below(N - 1);
    for (std::uint32_t i = 0; i < N; ++i) text[i] = i < length ? static_cast<char>('a' + below(26)) : '\0';
  }

 private:
  std::mt19937_64 engine_;
};

inline void randomise(Dice& dice, ToolState& m) {
  m.tool = dice.below(max_tools);
  dice.fill(m.tick), dice.fill(m.stamp_ns), dice.fill(m.p_WT), dice.fill_unit(m.q_WT), dice.fill(m.v_WT);
  dice.fill(m.w_WT), dice.fill(m.proxy), dice.fill(m.force_on_hand), dice.fill(m.force_now),
      dice.fill(m.torque_now), dice.fill(m.contact_set), dice.fill(m.buttons);
  m.engaged = dice.below(2);
}
inline void randomise(Dice& dice, ContactPatch& m) {
  m.tool = dice.below(max_tools);
  dice.fill(m.tick), dice.fill(m.stamp_ns), dice.fill(m.answers), dice.fill(m.answers_ns),
      dice.fill(m.contact_set);
  m.n_facets = dice.below(max_patch_facets + 1);
  for (std::uint32_t i = 0; i < m.n_facets; ++i) {
    PatchFacet& f = m.facets[i];
    dice.fill(f.corners), dice.fill(f.point), dice.fill_unit(f.normal), dice.fill(f.velocity);
    f.stiffness = dice.below(4) == 0 ? rigid_stiffness : dice.real(1, 1e5);
    f.damping = dice.real(0, 10);
    f.body = dice.below(max_bodies);
  }
}
inline void randomise(Dice& dice, ToolWrench& m) {
  m.tool = dice.below(max_tools);
  dice.fill(m.tick), dice.fill(m.stamp_ns), dice.fill(m.force), dice.fill(m.moment);
  dice.fill(m.set_point), dice.fill(m.stiffness), dice.fill(m.n_contacts);
  dice.fill(m.answers), dice.fill(m.answers_ns), dice.fill(m.p_WT), dice.fill_unit(m.q_WT);
  dice.fill(m.tip), dice.fill(m.stretch);
  m.t = dice.real(0, 10);
  if (dice.below(4) > 0) dice.fill_unit(m.normal);
}
inline void randomise(Dice& dice, BodySurface& m) {
  m.body = dice.below(max_bodies);
  m.revision = 1 + dice.below(1000);
  m.n_chunks = 1 + dice.below(max_surface_chunks);
  m.chunk = dice.below(m.n_chunks);
  m.n_vertices = 1 + dice.below(max_surface_vertices), m.n_facets = dice.below(max_surface_facets + 1);
  m.first_vertex = m.chunk * max_surface_vertices, m.first_facet = m.chunk * max_surface_facets;
  m.total_vertices =
      std::max(m.first_vertex + m.n_vertices, m.n_chunks * max_surface_vertices - dice.below(2000));
  m.total_facets = std::max(m.first_facet + m.n_facets, m.n_chunks * max_surface_facets - dice.below(2000));
  dice.fill(m.facets_hidden);
  m.rigid = dice.below(2);
  for (std::uint32_t i = 0; i < m.n_vertices; ++i) dice.fill(m.position[i]);
  for (std::uint32_t i = 0; i < m.n_facets; ++i) {
    for (std::uint32_t& corner : m.corners[i]) corner = dice.below(m.total_vertices);
    dice.fill(m.rgba[i]);
  }
}
inline void randomise(Dice& dice, SurfaceChange& m) {
  m.body = dice.below(max_bodies);
  m.revision = 1 + dice.below(1000);
  m.change = 1 + dice.below(1000);
  m.page = dice.below(max_change_pages);
  m.n_vertices = 1 + dice.below(max_change_vertices), m.n_changes = 1 + dice.below(max_change_facets);
  m.first_vertex = dice.below(1'000'000), m.first_change = m.page * max_change_facets;
  m.total_vertices = m.first_vertex + m.n_vertices + dice.below(1000);
  m.total_changes =
      std::min(m.first_change + m.n_changes + dice.below(1000), max_change_pages * max_change_facets);
  m.total_facets = dice.below(1'000'000);
  dice.fill(m.facets_hidden);
  for (std::uint32_t i = 0; i < m.n_vertices; ++i) dice.fill(m.position[i]);
  for (std::uint32_t i = 0; i < m.n_changes; ++i) {
    FacetChange& f = m.facets[i];
    f.facet = dice.below(1'000'000);
    for (std::uint32_t& corner : f.corners) corner = dice.below(m.total_vertices);
    dice.fill(f.rgba);
  }
}
/// Changes that are complete with one page.
inline void make_whole(SurfaceChange& m) {
  m.page = m.first_change = 0;
  m.total_changes = m.n_changes;
  m.total_vertices = m.first_vertex + m.n_vertices;
  for (FacetChange& facet : m.facets)
    for (std::uint32_t& corner : facet.corners) corner %= m.total_vertices;
}
inline void randomise(Dice& dice, VertexBlock& m) {
  m.body = dice.below(max_bodies);
  m.revision = 1 + dice.below(1000);
  m.block = dice.below(max_surface_chunks);
  dice.fill(m.tick);
  m.t = dice.real(0, 10);
  m.first_vertex = m.block * max_block_vertices;
  m.n_vertices = dice.below(max_block_vertices + 1);
  for (std::uint32_t i = 0; i < m.n_vertices; ++i) {
    dice.fill(m.position[i]);
    m.flags[i] = static_cast<std::uint8_t>(dice.below(256));
    if ((m.flags[i] & vertex_yielded) == 0) m.flags[i] &= vertex_broken;
  }
}
inline void randomise(Dice& dice, HapticTrace& m) {
  m.tool = dice.below(max_tools);
  dice.fill(m.batch);
  m.n_samples = dice.below(max_trace_samples + 1);
  const std::uint64_t first = dice.integer() >> 1;
  for (std::uint32_t i = 0; i < m.n_samples; ++i) {
    TraceSample& s = m.samples[i];
    s.tick = first + i;
    s.t = dice.real(0, 10);
    dice.fill(s.p), dice.fill(s.proxy), dice.fill(s.force), dice.fill(s.torque), dice.fill(s.energy);
  }
}
inline void randomise(Dice& dice, Pointer& m) {
  m.tool = dice.below(max_tools);
  dice.fill(m.tick), dice.fill(m.stamp_ns), dice.fill(m.p_W), dice.fill_unit(m.q_W), dice.fill(m.buttons);
  m.held = dice.below(2);
}
inline void randomise(Dice& dice, Command& m) {
  dice.fill(m.id), dice.fill(m.value), dice.fill_text(m.name);
  m.kind = static_cast<CommandKind>(dice.below(n_command_kinds));
}
inline void randomise(Dice& dice, NodeStatus& m) {
  m.node = static_cast<NodeKind>(dice.below(n_node_kinds));
  m.phase = static_cast<NodePhase>(dice.below(n_node_phases));
  dice.fill(m.pid), dice.fill(m.scene_checksum), dice.fill(m.ticks), dice.fill(m.late);
  dice.fill(m.samples_received), dice.fill(m.samples_lost), dice.fill(m.rejected), dice.fill(m.foreign);
  dice.fill(m.warnings), dice.fill_text(m.refused);
  dice.fill(m.lateness), dice.fill_text(m.note), dice.fill(m.energy_J), dice.fill(m.surplus_J);
  dice.fill(m.stale_events), dice.fill(m.safe_events), dice.fill(m.faults);
  m.t = dice.real(0, 1e4), m.rate_Hz = dice.real(0, 1e4), m.real_time_factor = dice.real(0, 9);
  m.loop_age_ms_p50 = dice.real(0, 9);
}

template <class M>
M random_message(std::uint64_t seed) {
  Dice dice(seed);
  M message;
  randomise(dice, message);
  return message;
}

// Every field, for comparison one by one. Elements beyond the counts are default in what is compared.
inline auto fields(const ToolState& m) {
  return std::tie(m.tool, m.tick, m.stamp_ns, m.p_WT, m.q_WT, m.v_WT, m.w_WT, m.proxy, m.force_on_hand,
                  m.force_now, m.torque_now, m.contact_set, m.buttons, m.engaged);
}
inline auto fields(const PatchFacet& m) {
  return std::tie(m.corners, m.point, m.normal, m.velocity, m.stiffness, m.damping, m.body);
}
inline auto fields(const ToolWrench& m) {
  return std::tie(m.tool, m.tick, m.stamp_ns, m.answers, m.answers_ns, m.t, m.p_WT, m.q_WT, m.force, m.moment,
                  m.set_point, m.tip, m.stiffness, m.normal, m.stretch, m.n_contacts);
}
inline auto fields(const BodySurface& m) {
  return std::tie(m.body, m.revision, m.chunk, m.n_chunks, m.total_vertices, m.total_facets, m.facets_hidden,
                  m.rigid, m.first_vertex, m.n_vertices, m.first_facet, m.n_facets, m.position, m.corners,
                  m.rgba);
}
inline auto fields(const FacetChange& m) { return std::tie(m.facet, m.corners, m.rgba); }
inline auto fields(const VertexBlock& m) {
  return std::tie(m.body, m.revision, m.block, m.tick, m.t, m.first_vertex, m.n_vertices, m.position,
                  m.flags);
}
inline auto fields(const TraceSample& m) {
  return std::tie(m.tick, m.t, m.p, m.proxy, m.force, m.torque, m.energy);
}
inline auto fields(const Pointer& m) {
  return std::tie(m.tool, m.tick, m.stamp_ns, m.p_W, m.q_W, m.buttons, m.held);
}
inline auto fields(const Command& m) { return std::tie(m.id, m.kind, m.value, m.name); }
inline auto fields(const NodeStatus& m) {
  return std::tie(m.node, m.phase, m.pid, m.scene_checksum, m.t, m.rate_Hz, m.real_time_factor,
                  m.loop_age_ms_p50, m.ticks, m.late, m.samples_received, m.samples_lost, m.rejected,
                  m.foreign, m.refused, m.warnings, m.energy_J, m.surplus_J, m.stale_events, m.safe_events,
                  m.faults, m.lateness, m.note);
}
template <class M>
bool same(const M& a, const M& b) {
  return fields(a) == fields(b);
}
inline bool same(const ContactPatch& a, const ContactPatch& b) {
  const auto head = [](const ContactPatch& m) {
    return std::tie(m.tool, m.tick, m.stamp_ns, m.answers, m.answers_ns, m.contact_set, m.n_facets);
  };
  return head(a) == head(b) &&
         std::equal(a.facets.begin(), a.facets.end(), b.facets.begin(),
                    [](const auto& x, const auto& y) { return fields(x) == fields(y); });
}
inline bool same(const SurfaceChange& a, const SurfaceChange& b) {
  const auto head = [](const SurfaceChange& m) {
    return std::tie(m.body, m.revision, m.page, m.change, m.total_vertices, m.total_facets, m.total_changes,
                    m.facets_hidden, m.first_vertex, m.n_vertices, m.first_change, m.n_changes, m.position);
  };
  return head(a) == head(b) &&
         std::equal(a.facets.begin(), a.facets.end(), b.facets.begin(),
                    [](const auto& x, const auto& y) { return fields(x) == fields(y); });
}
inline bool same(const HapticTrace& a, const HapticTrace& b) {
  return std::tie(a.tool, a.batch, a.n_samples) == std::tie(b.tool, b.batch, b.n_samples) &&
         std::equal(a.samples.begin(), a.samples.end(), b.samples.begin(),
                    [](const auto& x, const auto& y) { return fields(x) == fields(y); });
}

}  // namespace palpate::test
