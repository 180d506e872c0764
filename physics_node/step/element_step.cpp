#include "physics_node/step/element_step.h"

#include <cstdlib>
#include <cstring>
#include <utility>

#include "physics_node/step/element_context.h"

namespace palpate::physics {
namespace {

template <class Real>
ElementContext<Real> make_context(const Body& body, LatticeState<Real>& s, double dt, const Vec3& gravity) {
  ElementContext<Real> m = {};
  for (std::size_t a = 0; a < 3; ++a) {
    m.u[a] = s.u[a].data();
    m.v[a] = s.v[a].data();
    m.next_u[a] = s.next_u[a].data();
    m.next_v[a] = s.next_v[a].data();
    m.g[a] = static_cast<Real>(gravity[static_cast<Eigen::Index>(a)]);
  }
  m.rows = body.lattice.rows.data();
  for (std::size_t parity = 0; parity < 2; ++parity)
    for (std::size_t d = 0; d < max_directions; ++d) m.offset[parity][d] = body.lattice.offset[parity][d];
  m.inverse_mass = s.inverse_mass.data();
  m.mask = s.mask.data();
  m.dt = static_cast<Real>(dt);
  const auto n_half = static_cast<std::size_t>(body.lattice.n_half);
  for (std::size_t d = 0; d < 2 * n_half; ++d) {
    for (std::size_t a = 0; a < 3; ++a)
      m.D[a][d] = static_cast<Real>(body.lattice.rest_vector[d][static_cast<Eigen::Index>(a)]);
    m.L[d] = static_cast<Real>(body.lattice.rest_length[d]);
    m.k1[d] = static_cast<Real>(body.law.k1[d % n_half]);
    m.k2[d] = static_cast<Real>(body.law.k1[d % n_half] * body.law.k2_ratio);
    m.c[d] = static_cast<Real>(body.law.c[d % n_half]);
  }
  for (std::size_t d = 0; d < n_half; ++d) {
    m.l_c[d] = s.l_c[d].data();
    m.y_p[d] = s.y_p[d].data();
  }
  return m;
}

template <class Real>
ElementKernel<Real> choose_kernel(const Body& body) {
  const KernelKind kind{body.lattice.kind == LatticeKind::fcc, body.law.damped, body.law.yields};
  switch (instruction_set()) {
    case InstructionSet::avx512:
      return avx512::element_kernel<Real>(kind);
    case InstructionSet::avx2:
      return avx2::element_kernel<Real>(kind);
    case InstructionSet::sse2:
      break;
  }
  return sse2::element_kernel<Real>(kind);
}

InstructionSet find_instruction_set() noexcept {
  const char* wanted = std::getenv("PALPATE_ISA");
  const bool sse2_wanted = wanted != nullptr && std::strcmp(wanted, "sse2") == 0;
  const bool avx2_wanted = wanted != nullptr && std::strcmp(wanted, "avx2") == 0;
  if (!sse2_wanted && !avx2_wanted && __builtin_cpu_supports("avx512f") != 0) return InstructionSet::avx512;
  if (!sse2_wanted && __builtin_cpu_supports("avx2") != 0) return InstructionSet::avx2;
  return InstructionSet::sse2;
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
void element_step(const Body& body, LatticeState<Real>& state, double dt, const Vec3& gravity,
                  int threads) noexcept {
  const ElementContext<Real> m = make_context(body, state, dt, gravity);
  const ElementKernel<Real> kernel = choose_kernel<Real>(body);
  const auto n_rows = static_cast<Index>(body.lattice.rows.size());
  if (threads <= 1) {
    kernel(m, 0, n_rows);
  } else {
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int part = 0; part < threads; ++part) {
      const auto at = [&](int p) {
        return static_cast<Index>(static_cast<std::int64_t>(n_rows) * p / threads);
      };
      kernel(m, at(part), at(part + 1));
    }
  }
  std::swap(state.u, state.next_u);
  std::swap(state.v, state.next_v);
}

template void element_step(const Body&, LatticeState<float>&, double, const Vec3&, int) noexcept;
template void element_step(const Body&, LatticeState<double>&, double, const Vec3&, int) noexcept;

}  // namespace palpate::physics
