#include "physics_node/step/fem/hex_stiffness.h"

#include "physics_node/material/stable_neo_hookean.h"

namespace palpate::physics {

HexMatrix hex_stiffness(const HexMaterial& material, const Vec3& edge) {
  using One = Scalar<double>;
  const HexConstants<double> k = hex_constants<double>(material, edge);
  const double d = 1e-6 * edge.minCoeff();
  const auto forces = [&](std::size_t e, double size) {
    Corners<One> w{};
    w[e % 3][e / 3] = size;
    HexForces<One> out;
    if (material.hourglass == HourglassKind::physical)
      hex_forces<One, StableNeoHookean, true, false>(k, w, out);
    else
      hex_forces<One, StableNeoHookean, false, false>(k, w, out);
    return out;
  };
  HexMatrix K;
  for (std::size_t e = 0; e < 24; ++e) {
    const auto plus = forces(e, d), minus = forces(e, -d);
    for (std::size_t o = 0; o < 24; ++o)
      K(static_cast<Eigen::Index>(o), static_cast<Eigen::Index>(e)) =
          (minus.f[o % 3][o / 3] - plus.f[o % 3][o / 3]) / (2 * d);
  }
  return 0.5 * (K + K.transpose());
}

}  // namespace palpate::physics
