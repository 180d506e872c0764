#include "physics_node/step/lattice/stable_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "physics_node/body/element_constants.h"
#include "physics_node/step/fem/tet_spectrum.h"
#include "physics_node/step/lattice/hex_spectrum.h"
#include "physics_node/step/lattice/lattice_spectrum.h"
#include "physics_node/step/surface_mesh/surface_spectrum.h"

namespace palpate::physics {
namespace {

StiffestMode bloch(const Body& body) {
  std::array<double, max_half> k{}, c{};
  double drag = 0;
  for (const ElementLaw& law : body.laws) {
    for (std::size_t h = 0; h < static_cast<std::size_t>(body.lattice.n_half); ++h) {
      k[h] = std::max(k[h], law.k1[h]);
      c[h] = std::max(c[h], law.c[h]);
    }
    drag = std::max(drag, law.drag);
  }
  const double w = *std::max_element(body.inverse_mass.begin(), body.inverse_mass.end());
  const double c_max = any_damped(body) ? largest_eigenvalue(body.lattice, c) : 0.0;
  return {largest_eigenvalue(body.lattice, k) * w, (c_max + drag) * w};
}

}  // namespace

StiffestMode stiffest_mode_anyhow(const Body& body) {
  StiffestMode mode;
  for (const Index cell : body.lattice.masses) {
    const auto i = static_cast<std::size_t>(cell);
    const double w = body.inverse_mass[i];
    if (w == 0) continue;
    const auto& offset = body.lattice.offset[static_cast<std::size_t>(body.lattice.row_kind(cell))];
    double sum_k = 0;
    double sum_c = 0;
    for (std::size_t d = 0; d < static_cast<std::size_t>(2 * body.lattice.n_half); ++d) {
      if (((body.lattice.mask[i] >> d) & 1) == 0) continue;
      const ElementConstants e =
          element_constants(body, cell, cell + offset[d], d % static_cast<std::size_t>(body.lattice.n_half));
      sum_k += e.k1;
      sum_c += e.c;
    }
    mode.omega2 = std::max(mode.omega2, 2 * sum_k * w);
    mode.gamma = std::max(mode.gamma, (2 * sum_c + law_at(body, cell).drag) * w);
  }
  return mode;
}

StiffestMode stiffest_mode(const Body& body) {
  if (is_surface_of_springs(body)) {
    const StiffestMode whole = stiffest_mode_of_surface(*body.mesh->springs, body.inverse_mass);
    if (!body.mesh->triangles) return whole;
    const StiffestMode cut = stiffest_mode_of_loose_triangles(*body.mesh->springs);
    return {std::max(whole.omega2, cut.omega2), std::max(whole.gamma, cut.gamma)};
  }
  if (body.mesh && body.mesh->net) return stiffest_mode_when_cut(body.mesh->model);
  if (body.mesh) return stiffest_mode_of_tetrahedra(body.mesh->model);
  if (body.solid) return stiffest_mode_of_hexahedra(body);
  const StiffestMode anyhow = stiffest_mode_anyhow(body);
  if (body.law.damper != Damper::axial || anyhow.omega2 == 0) return anyhow;  // not an axial law
  const StiffestMode ordered = bloch(body);
  return {std::min(anyhow.omega2, ordered.omega2), std::min(anyhow.gamma, ordered.gamma)};
}

double stable_step(const StiffestMode& mode, Integrator integrator) {
  if (integrator == Integrator::backward_euler || mode.omega2 <= 0)
    return std::numeric_limits<double>::infinity();
  const double gamma = integrator == Integrator::velocity_verlet ? 2 * mode.gamma : mode.gamma;
  return (std::sqrt(gamma * gamma + 4 * mode.omega2) - gamma) / mode.omega2;
}

}  // namespace palpate::physics
