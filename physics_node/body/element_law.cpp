#include "physics_node/body/element_law.h"

#include <Eigen/Dense>
#include <numbers>

#include "common/scene/material_spec.h"

namespace palpate::physics {
namespace {

constexpr std::array<std::array<int, 2>, 6> voigt{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};

/// Relative spring constants of a lattice, before they are scaled to a modulus. On cubic voxels, axes : diagonals =
/// 1 : 2 gives C11 = 3 C12 = 3 C44, an isotropic solid of Poisson's ratio 1/4; on others each spring takes the same share
/// of its direction's stiffness k L^2 / V.
std::array<double, max_half> relative_constants(const Lattice& lattice) {
  constexpr std::array<double, max_half> share{1, 1, 1, 4, 4, 4, 4, 4, 4};
  std::array<double, max_half> k{};
  for (std::size_t d = 0; d < static_cast<std::size_t>(lattice.n_half); ++d) {
    const double L = lattice.rest_length[d];
    k[d] = lattice.kind == LatticeKind::fcc ? 1.0 : share[d] * lattice.step.prod() / (L * L);
  }
  return k;
}

}  // namespace

double volume_per_mass(const Lattice& lattice) {
  // fcc: steps of L / sqrt(2), every other grid point holds a mass: 2 (L / sqrt 2)^3 = L^3 / sqrt 2.
  return (lattice.kind == LatticeKind::fcc ? 2.0 : 1.0) * lattice.step.prod();
}

Eigen::Matrix<double, 6, 6> homogenised_stiffness(const Lattice& lattice,
                                                  const std::array<double, max_half>& k1) {
  Eigen::Matrix<double, 6, 6> C = Eigen::Matrix<double, 6, 6>::Zero();
  for (std::size_t d = 0; d < static_cast<std::size_t>(lattice.n_half); ++d) {
    const double L = lattice.rest_length[d];
    const Vec3 n = lattice.axes.transpose() * lattice.rest_vector[d] / L;
    Eigen::Matrix<double, 6, 1> nn;
    for (std::size_t a = 0; a < 6; ++a) nn[static_cast<Eigen::Index>(a)] = n[voigt[a][0]] * n[voigt[a][1]];
    C += elements_per_mass(lattice.kind, d) * k1[d] * L * L / volume_per_mass(lattice) * nn * nn.transpose();
  }
  return C;
}

double axial_modulus(const Eigen::Matrix<double, 6, 6>& stiffness) {
  const Eigen::Matrix<double, 6, 6> compliance = stiffness.inverse();
  return (1.0 / compliance(0, 0) + 1.0 / compliance(1, 1) + 1.0 / compliance(2, 2)) / 3.0;
}

ElementLaw element_law(const Lattice& lattice, const MaterialSpec& material) {
  ElementLaw law;
  law.mass = material.mass ? *material.mass : *material.density * volume_per_mass(lattice);
  const auto n_half = static_cast<std::size_t>(lattice.n_half);
  if (material.k1 || material.lambda) {
    for (std::size_t d = 0; d < n_half; ++d)
      law.k1[d] = material.k1 ? *material.k1 : *material.lambda / lattice.rest_length[d];
    law.modulus = axial_modulus(homogenised_stiffness(lattice, law.k1));
  } else {
    law.k1 = relative_constants(lattice);
    const double scale = *material.modulus / axial_modulus(homogenised_stiffness(lattice, law.k1));
    for (std::size_t d = 0; d < n_half; ++d) law.k1[d] *= scale;
    law.modulus = *material.modulus;
  }
  for (std::size_t d = 0; d < n_half; ++d) {
    if (material.viscosity) law.c[d] = *material.viscosity;
    if (material.viscosity_bulk) law.c[d] = *material.viscosity_bulk * law.k1[d] / law.modulus;
    law.damped = law.damped || law.c[d] > 0;
  }
  law.damper = material.damper;
  law.drag = material.drag;
  law.k2_ratio = material.k2_ratio;
  law.cut_toughness = material.cut_toughness.value_or(0.0);
  law.puncture_ratio = material.puncture_ratio;
  law.yields = material.yield_ratio.has_value();
  law.y_p = material.yield_ratio.value_or(0.0);
  law.b_p = material.break_ratio.value_or(0.0);
  return law;
}

}  // namespace palpate::physics
