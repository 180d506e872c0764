#include "physics_node/step/lattice/hex_yield.h"

#include <algorithm>

#include "physics_node/step/lattice/hex_meter.h"

namespace palpate::physics {

template <class Real>
HexYield<Real>::HexYield(const Body& body, const HexGrid& grid, std::size_t colour)
    : body_(body),
      grid_(grid),
      k_(hex_constants_of<Real>(body)),
      limit_(static_cast<std::size_t>(body.capacity()), colour),
      hardening_(static_cast<std::size_t>(body.capacity()), colour + 1),
      of_run_(grid.runs.size()),
      kernel_(hex_flow_kernel_here<Real>()) {
  const SolidElements& solid = *body.solid;
  // Sums of a row of G: two of bending, four of twist.
  double most = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      most =
          std::max({most, 2 * static_cast<double>(k_.bend[i][j]), 4 * static_cast<double>(k_.twist[i][j])});
  most_bent_ = static_cast<Real>(3 * most / static_cast<double>(k_.volume * k_.mu));
  const HexConstants<double> k = hex_constants_of<double>(body);
  std::vector<YieldLimit> limits;
  for (const Yielding& yielding : solid.yields) limits.push_back(yield_limit(yielding, k.mu, k.lambda));
  for (const HexRun& run : grid.runs)
    for (Index cell = run.first; cell < run.first + run.count; ++cell) {
      const auto c = static_cast<std::size_t>(cell);
      if (solid.stiffness[c] <= 0) continue;
      limit_[c] = static_cast<Real>(limits[solid.material_of[c]].stress);
      hardening_[c] = static_cast<Real>(limits[solid.material_of[c]].hardening);
    }
}

/// The state was set from outside: what has yielded may be other cells.
template <class Real>
void HexYield<Real>::follow(const LatticeState<Real>& state) noexcept {
  if (replacements_ == state.replacements) return;
  replacements_ = state.replacements;
  const ZeroedArray<Real>& alpha = state.plastic.memory.back();
  for (std::size_t r = 0; r < grid_.runs.size(); ++r) {
    const HexRun& run = grid_.runs[r];
    const Real* first = alpha.data() + run.first;
    const bool any = std::any_of(first, first + run.count, [](Real a) { return a > 0; });
    of_run_[r] = {.found = any ? Yielded::yielded : Yielded::near};
  }
}

template <class Real>
void HexYield<Real>::begin_step(LatticeState<Real>& state, const HexActing& acting, const ExplicitStep& step,
                                const ZeroedArray<Real>& stiffness, Three<Real>& high) noexcept {
  follow(state);
  HexFlowContext<Real> m = {};
  m.runs = grid_.runs.data();
  m.acts = acting.flags();
  m.of_run = of_run_.data();
  for (std::size_t a = 0; a < 3; ++a) {
    m.u[a] = state.u[a].data();
    m.v[a] = state.v[a].data();
    m.f[a] = state.f[a].data();
    m.high[a] = high[a].data();
  }
  m.stiffness = stiffness.data();
  m.begun = state.failed.reached.size() > 0 ? state.failed.reached.data() : nullptr;
  m.limit = limit_.data();
  m.hardening = hardening_.data();
  for (std::size_t n = 0; n < n_plastic; ++n) m.memory[n] = state.plastic.memory[n].data();
  m.up_y = grid_.up_y, m.up_z = grid_.up_z;
  m.dt_before = static_cast<Real>(state.dt_before);
  m.most_bent = most_bent_;
  m.watch = step.watch;
  m.k = k_;
  const std::span layers = acting.layers();
  const std::span slabs = acting.slabs();
  // Layers of cells give to other planes of f and of high than each other: see HexContext.
  const auto of_slab = [&](std::size_t n) {
    for (std::size_t l = slabs[n].begin; l < slabs[n].end; ++l)
      kernel_(m, layers[l].first_run, layers[l].last_run);
  };
  const auto is_far = [](const RunYield& run) { return run.found == Yielded::far; };
  if (!step.watch && std::ranges::all_of(of_run_, is_far)) return;
  if (step.team != nullptr && step.threads > 1)
    step.team->each(slabs.size(), step.threads, of_slab);
  else
    for (std::size_t n = 0; n < slabs.size(); ++n) of_slab(n);
  bool any = false;
  for (const HexLayer& layer : layers)
    for (auto r = static_cast<std::size_t>(layer.first_run); r < static_cast<std::size_t>(layer.last_run);
         ++r) {
      const RunYield& run = of_run_[r];
      if (run.flows == 0) continue;
      any = true;
      RowLedger& ledger = state.ledger[static_cast<std::size_t>(body_.lattice.row_of(grid_.runs[r].first))];
      ledger.plastic += run.plastic;
      ledger.numerical += run.numerical;
      ledger.yields += run.flows;
    }
  if (any) ++state.plastic.changes;
}

template <class Real>
void HexYield<Real>::watch(LatticeState<Real>& state) const noexcept {
  for (std::size_t r = 0; r < state.ledger.size(); ++r) {
    if (state.row_state[r] == RowState::asleep) continue;  // as the kernel leaves it, too
    for (Index n = grid_.runs_of_row[r]; n < grid_.runs_of_row[r + 1]; ++n)
      state.ledger[r].elastic += of_run_[static_cast<std::size_t>(n)].elastic;
  }
}

template <class Real>
void HexYield<Real>::stiffen(const HexActing& acting, std::vector<double>& stiffest) const noexcept {
  for (std::size_t r = 0; r < stiffest.size(); ++r)
    if (acting.acts(static_cast<Index>(r))) stiffest[r] += of_run_[r].stiffness;
}

template class HexYield<float>;
template class HexYield<double>;

}  // namespace palpate::physics
