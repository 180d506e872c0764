#include "physics_node/step/stable_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpate::physics {

double stable_step(const Body& body) {
  double smallest = std::numeric_limits<double>::infinity();
  const auto n_half = static_cast<std::size_t>(body.lattice.n_half);
  for (const Index cell : body.lattice.masses) {
    const auto i = static_cast<std::size_t>(cell);
    double sum_k = 0;
    double sum_c = 0;
    for (std::size_t d = 0; d < 2 * n_half; ++d) {
      if (((body.lattice.mask[i] >> d) & 1) == 0) continue;
      sum_k += body.law.k1[d % n_half];
      sum_c += body.law.c[d % n_half];
    }
    const double omega2 = 2 * sum_k * body.inverse_mass[i];
    const double gamma = 2 * sum_c * body.inverse_mass[i];
    if (omega2 <= 0) continue;
    smallest = std::min(smallest, (std::sqrt(gamma * gamma + 4 * omega2) - gamma) / omega2);
  }
  return smallest;
}

}  // namespace palpate::physics
