#include "physics_node/step/state.h"

#include <algorithm>

namespace palpate::physics {

template <class Real>
LatticeState<Real>::LatticeState(const Body& body) {
  const auto n = static_cast<std::size_t>(body.lattice.n_cells());
  for (auto* three : {&u, &v, &next_u, &next_v})
    for (auto& array : *three) array = ZeroedArray<Real>(n);
  mask = ZeroedArray<Mask>(n);
  flags = ZeroedArray<std::uint8_t>(n);
  inverse_mass = ZeroedArray<Real>(n);
  if (body.law.yields) {
    for (std::size_t d = 0; d < static_cast<std::size_t>(body.lattice.n_half); ++d) {
      l_c[d] = ZeroedArray<Real>(n);
      y_p[d] = ZeroedArray<Real>(n);
    }
  }
  for (const Index cell : body.lattice.masses) {
    const auto c = static_cast<std::size_t>(cell);
    inverse_mass[c] = static_cast<Real>(body.inverse_mass[c]);
  }
  reset(body);
}

template <class Real>
void LatticeState<Real>::reset(const Body& body) {
  for (const Index cell : body.lattice.masses) {
    const auto c = static_cast<std::size_t>(cell);
    const bool held = body.inverse_mass[c] == 0;
    for (std::size_t a = 0; a < 3; ++a) {
      u[a][c] = next_u[a][c] = 0;
      v[a][c] = next_v[a][c] =
          held ? Real(0) : static_cast<Real>(body.velocity[static_cast<Eigen::Index>(a)]);
    }
    mask[c] = body.lattice.mask[c];
    flags[c] = 0;
    if (!body.law.yields) continue;
    for (std::size_t d = 0; d < static_cast<std::size_t>(body.lattice.n_half); ++d) {
      l_c[d][c] = 0;
      y_p[d][c] = static_cast<Real>(body.law.y_p);
    }
  }
}

template struct LatticeState<float>;
template struct LatticeState<double>;

}  // namespace palpate::physics
