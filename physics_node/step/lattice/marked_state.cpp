#include "physics_node/step/lattice/marked_state.h"

#include <algorithm>

namespace palpate::physics {

template <class Real>
MarkedState<Real>::MarkedState(const Body& body, const LatticeState<Real>& state) : saved_(body, state) {
  if (const CellNet* net = body.cell_net()) open_.reserve(net->most_open());
  if (is_awake_in_parts(body)) return;
  const auto n = static_cast<std::size_t>(body.capacity());
  for (auto& axis : v_) axis = ZeroedArray<Real>(n);
  for (std::size_t a = 0; a < 3; ++a)
    if (state.v_half[a].size() > 0) v_half_[a] = ZeroedArray<Real>(n);
}

template <class Real>
void MarkedState<Real>::take(const Body& body, const LatticeState<Real>& state) noexcept {
  open_.clear();
  if (const CellNet* net = body.cell_net())
    for (const auto& [cell, axis] : net->open_faces())
      open_.push_back({cell, net->beyond(cell, 2 * axis + 1), net->cut_at(cell, axis)});
  if (is_awake_in_parts(body)) return;
  saved_.take(body, state);
  for (std::size_t a = 0; a < 3; ++a) {
    copy_nodes(body, state.v[a], v_[a]);
    if (v_half_[a].size() > 0) copy_nodes(body, state.v_half[a], v_half_[a]);
  }
}

template <class Real>
void MarkedState<Real>::bring_back(const Body& body, LatticeState<Real>& state) const noexcept {
  if (is_awake_in_parts(body)) return;
  saved_.bring_back(body, state);
  for (std::size_t a = 0; a < 3; ++a) {
    copy_nodes(body, v_[a], state.v[a]);
    if (v_half_[a].size() > 0) copy_nodes(body, v_half_[a], state.v_half[a]);
  }
}

template class MarkedState<float>;
template class MarkedState<double>;

}  // namespace palpate::physics
