#include "physics_node/step/lattice/parted_cells.h"

namespace palpate::physics {

template <class Real>
PartedCells<Real>::PartedCells(const Body& body) {
  const CellNet& net = *body.solid->net;
  const auto most = static_cast<Index>(std::min(7 * net.most_copies(), net.cells().size()));
  stride_ = (most + row_segment - 1) / row_segment * row_segment;
  const auto n = 8 * static_cast<std::size_t>(stride_);
  std::size_t colour = 0;
  for (auto* three : {&u_, &v_, &low_, &high_})
    for (auto& axis : *three) axis = ZeroedArray<Real>(n, colour++);
  if (body.solid->beta > 0)
    for (auto* three : {&rate_low_, &rate_high_})
      for (auto& axis : *three) axis = ZeroedArray<Real>(n, colour++);
  stiffness_ = ZeroedArray<Real>(static_cast<std::size_t>(stride_), colour);
  acting_.reserve(static_cast<std::size_t>(most));
}

/// After a reset.
template <class Real>
void PartedCells<Real>::leave(const Body& body, ZeroedArray<Real>& stiffness) noexcept {
  for (const Index cell : body.solid->net->cells())
    stiffness[static_cast<std::size_t>(cell)] =
        static_cast<Real>(body.solid->stiffness[static_cast<std::size_t>(cell)]);
  known_ = 0;
  power_ = 0, least_J_ = 1;
}

template <class Real>
void PartedCells<Real>::list_acting(const Body& body, const HexGrid& grid,
                                    const LatticeState<Real>& state) noexcept {
  const CellNet& net = *body.solid->net;
  std::fill_n(stiffness_.data(), acting_.size(), Real(0));
  acting_.clear();
  for (std::size_t n = 0; n < known_; ++n) {
    const Index cell = net.parted()[n];
    if (!state.acts.empty() && state.acts[grid.run_of(cell)] == 0) continue;
    stiffness_[acting_.size()] = static_cast<Real>(body.solid->stiffness[static_cast<std::size_t>(cell)]);
    acting_.push_back(n);
  }
  if (acting_.empty()) elastic_ = power_ = stiffest_ = 0;
}

template <class Real>
void PartedCells<Real>::follow(const Body& body, const HexGrid& grid, const LatticeState<Real>& state,
                               ZeroedArray<Real>& stiffness) noexcept {
  const CellNet& net = *body.solid->net;
  const std::size_t now = net.parted().size();
  const bool fewer = n_resets_ != net.n_resets();
  if (now == known_ && !fewer && (state.acts.empty() || row_changes_ == state.row_changes)) return;
  row_changes_ = state.row_changes;
  n_resets_ = net.n_resets();
  if (fewer) leave(body, stiffness);
  for (; known_ < now; ++known_) stiffness[static_cast<std::size_t>(net.parted()[known_])] = 0;
  list_acting(body, grid, state);
}

template <class Real>
void PartedCells<Real>::forces(const Body& body, LatticeState<Real>& state, const HexContext<Real>& sweep,
                               const HexKernel<Real>& kernel) noexcept {
  const CellNet& net = *body.solid->net;
  const bool damped = body.solid->beta > 0;
  const auto stride = static_cast<std::size_t>(stride_);
  for (std::size_t n = 0; n < acting_.size(); ++n) {
    const CellNet::Corners& corners = net.parted_corners(acting_[n]);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t a = 0; a < 8; ++a) {
        const auto node = static_cast<std::size_t>(corners[a]);
        u_[c][a * stride + n] = state.u[c][node];
        if (damped) v_[c][a * stride + n] = state.v[c][node];
      }
  }
  HexContext<Real> m = sweep;
  const HexRun run{0, static_cast<Index>(acting_.size()), stride_};
  m.runs = &run;
  m.acts = nullptr;
  m.torn = nullptr;
  m.stiffness = stiffness_.data();
  for (std::size_t c = 0; c < 3; ++c) {
    m.masses.u[c] = u_[c].data();
    m.masses.v[c] = v_[c].data();
    m.masses.f[c] = low_[c].data();
    m.high[c] = high_[c].data();
    m.rate_low[c] = rate_low_[c].data();
    m.rate_high[c] = rate_high_[c].data();
  }
  m.elastic = &elastic_, m.power = &power_, m.damped = &damped_;
  m.least_J = &least_J_, m.stiffest = &stiffest_;
  m.up_y = 2 * stride_, m.up_z = 4 * stride_;
  kernel.forces(m, 0, 1);
  const auto add = [&](Three<Real>& low, Three<Real>& high, Real* const* to) {
    for (std::size_t n = 0; n < acting_.size(); ++n) {
      const CellNet::Corners& corners = net.parted_corners(acting_[n]);
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t a = 0; a < 8; ++a) {
          Real& from = (a < 4 ? low : high)[c][a * stride + n];
          to[c][corners[a]] += from;
          from = 0;
        }
    }
  };
  add(low_, high_, sweep.masses.f);
  if (damped) add(rate_low_, rate_high_, sweep.rate_low);
}

template <class Real>
void PartedCells<Real>::move(const Body& body, LatticeState<Real>& state, const HexContext<Real>& sweep,
                             const HexKernel<Real>& kernel) noexcept {
  const CellNet& net = *body.solid->net;
  HexContext<Real> m = sweep;
  const RowSegment row{net.n_loaded(), net.n_copies(), 0};
  constexpr RowState awake = RowState::awake;
  constexpr std::array<Index, 2> its_run{0, 1};
  m.masses.rows = &row;
  m.masses.row_state = &awake;
  m.masses.ledger = &state.ledger.back();
  m.runs_of_row = its_run.data();
  m.elastic = &elastic_, m.power = &power_, m.damped = &damped_, m.passed = &passed_;
  kernel.move(m, 0, 1);
}

template class PartedCells<float>;
template class PartedCells<double>;

}  // namespace palpate::physics
