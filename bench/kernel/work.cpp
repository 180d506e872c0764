#include "bench/kernel/work.h"

namespace palpate::bench {

MassWork work_per_mass(const CubeKind& kind, const physics::Body& body) {
  double per_element = 29;
  if (kind.work == Work::damped) per_element += 12;
  if (kind.work == Work::plastic || kind.work == Work::yielding) per_element += 7;
  if (kind.work == Work::yielding) per_element += 4;
  const double elements =
      static_cast<double>(body.lattice.n_elements()) / static_cast<double>(body.lattice.n_masses());
  const double real = kind.precision == Precision::single_ ? 4 : 8;
  MassWork work;
  work.flops = elements * per_element + 18;
  work.bytes = 13 * real + sizeof(physics::Mask);
  if (body.law.yields) work.bytes += 2 * body.lattice.n_half * real;
  if (kind.work == Work::yielding) work.bytes += 2 * body.lattice.n_half * real;
  return work;
}

}  // namespace palpate::bench
