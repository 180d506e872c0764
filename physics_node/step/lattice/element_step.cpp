#include "physics_node/step/lattice/element_step.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "physics_node/step/lattice/kernel_choice.h"
#include "physics_node/step/lattice/mirror_breaks.h"

namespace palpate::physics {
namespace {

template <class Real>
void point_at_constants(ElementContext<Real>& m, const VariedConstants<Real>& varied) {
  for (std::size_t h = 0; h < max_half; ++h) {
    m.k1[h] = varied.k1[h].data();
    m.k2[h] = varied.k2[h].data();
    m.c[h] = varied.c[h].data();
    m.yield[h] = varied.yield[h].data();
    m.snap[h] = varied.snap[h].data();
  }
  m.drag_of = varied.drag.data();
}

template <class Real>
ElementContext<Real> make_context(const Body& body, LatticeState<Real>& s, const ExplicitStep& step,
                                  bool exact) {
  ElementContext<Real> m = {};
  m.rows = body.lattice.rows.data();
  m.row_state = s.row_state.data();
  m.ledger = s.ledger.data();
  m.all = s.all.data();
  m.level = s.level.data();
  m.up = s.up.data();
  for (std::size_t a = 0; a < 3; ++a) {
    m.u[a] = s.u[a].data();
    m.v[a] = s.v[a].data();
    m.f[a] = s.f[a].data();
    m.v_half[a] = s.v_half[a].data();
    m.kicked[a] = s.v_half_known ? s.v_half[a].data() : s.v[a].data();
    m.moved[a] = moving_velocity(s)[a].data();
    m.v_seen[a] = s.v_seen[a].data();
    m.g[a] = static_cast<Real>(step.gravity[static_cast<Eigen::Index>(a)]);
  }
  m.inverse_mass = s.inverse_mass.data();
  m.mask = s.mask.data();
  for (std::size_t h = 0; h < max_half; ++h) {
    m.l_c[h] = s.l_c[h].data();
    m.hardening[h] = s.hardening[h].data();
  }
  point_at_constants(m, s.varied);
  m.dt = static_cast<Real>(step.dt);
  m.kick = static_cast<Real>(s.v_half_known ? step.dt : 0.5 * step.dt);
  m.drag = static_cast<Real>(body.law.drag);
  m.relative = body.law.damper == Damper::relative;
  m.dt_before = static_cast<Real>(s.dt_before);
  m.begins = step.verlet ? !s.v_half_known : step.dt != s.dt_before;
  m.exact = step.exact;
  m.exact_axial = exact && body.law.damper == Damper::axial;
  m.watch = step.watch;
  return m;
}

template <class Real>
ElementKernel<Real> choose_kernel(const Body& body, bool verlet, bool exact) {
  const DamperKind damper = !any_damped(body)                  ? DamperKind::none
                            : body.law.damper == Damper::axial ? DamperKind::axial
                                                               : DamperKind::other;
  const KernelKind kind{damper, any_yields(body), !body.law_of.empty(), verlet, exact};
  return kernel_for(instruction_set(), kind, &sse2::element_kernel<Real>, &avx2::element_kernel<Real>,
                    &avx512::element_kernel<Real>);
}

InstructionSet find_instruction_set() noexcept {
  const char* wanted = std::getenv("PALPATE_ISA");
  const bool sse2_wanted = wanted != nullptr && std::strcmp(wanted, "sse2") == 0;
  const bool avx2_wanted = wanted != nullptr && std::strcmp(wanted, "avx2") == 0;
  const bool has_avx2 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
  const bool has_avx512 =
      __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512vl") != 0;  // vl: short tails
  if (!sse2_wanted && !avx2_wanted && has_avx2 && has_avx512) return InstructionSet::avx512;
  return !sse2_wanted && has_avx2 ? InstructionSet::avx2 : InstructionSet::sse2;
}

/// Dampers see now what they saw before, as far as anybody knows.
template <class Real>
void begin_seeing(const Body& body, LatticeState<Real>& s) {
  for (std::size_t a = 0; a < 3; ++a)
    for (const RowSegment& row : body.lattice.rows)
      std::copy_n(s.v[a].data() + row.first, row.count, s.v_seen[a].data() + row.first);
}

/// Every chunk but the last hands the elements above it to the sweep of cuts.
template <class Real>
void sweep_chunk(ElementKernel<Real> kernel, const ElementContext<Real>& m, const std::vector<Chunk>& chunks,
                 std::size_t n) {
  const Chunk& chunk = chunks[n];
  const bool last = n + 1 == chunks.size();
  kernel(m, chunk.first_row, last ? chunk.last_row : chunk.top_row, Sweep::all);
  if (!last) kernel(m, chunk.top_row, chunk.last_row, Sweep::level);
}

}  // namespace

InstructionSet instruction_set() noexcept {
  static const InstructionSet set = find_instruction_set();
  return set;
}

const char* name_of(InstructionSet set) noexcept {
  constexpr const char* names[] = {"sse2", "avx2", "avx512"};
  return names[static_cast<int>(set)];
}

template <class Real>
std::int64_t element_step(const Body& body, LatticeState<Real>& state, const ExplicitStep& step) noexcept {
  const bool exact = step.exact && state.v_seen[0].size() > 0;
  if (exact && !state.v_seen_known) begin_seeing(body, state);
  const ElementContext<Real> m = make_context(body, state, step, exact);
  const ElementKernel<Real> kernel = choose_kernel<Real>(body, step.verlet, exact);
  const std::vector<Chunk>& chunks = body.lattice.chunks;
  const std::size_t n = chunks.size();
  const std::size_t n_cuts = n > 0 ? n - 1 : 0;
  const auto cut = [&](std::size_t c) { kernel(m, chunks[c].top_row, chunks[c].last_row, Sweep::up); };
  const auto chunk = [&](std::size_t c) { sweep_chunk(kernel, m, chunks, c); };
  if (step.team != nullptr) {
    step.team->each(n_cuts, step.threads, cut);
    step.team->each(n, step.threads, chunk);
  } else {
    for (std::size_t c = 0; c < n_cuts; ++c) cut(c);
    for (std::size_t c = 0; c < n; ++c) chunk(c);
  }
  state.v_half_known = step.verlet;
  state.v_seen_known = exact;
  state.dt_before = step.dt;
  if (any_yields(body)) return mirror_breaks(body, state);
  state.fresh.begin_step();
  return 0;
}

template std::int64_t element_step(const Body&, LatticeState<float>&, const ExplicitStep&) noexcept;
template std::int64_t element_step(const Body&, LatticeState<double>&, const ExplicitStep&) noexcept;

}  // namespace palpate::physics
