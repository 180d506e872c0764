#include "physics_node/fragments/outcome.h"

#include <cmath>

#include "physics_node/fragments/measure_fragments.h"
#include "physics_node/fragments/section.h"

namespace palpate::physics {
namespace {

/// Of all masses at rest, about their centre [m].
double radius_of_gyration(const Body& body) {
  Vec3 center = Vec3::Zero();
  for (const Index cell : body.nodes()) center += body.rest_position(cell);
  center /= static_cast<double>(body.n_nodes());
  double sum = 0;
  for (const Index cell : body.nodes()) sum += (body.rest_position(cell) - center).squaredNorm();
  return std::sqrt(sum / static_cast<double>(body.n_nodes()));
}

}  // namespace

Outcome classify(const OutcomeMeasures& m) {
  if (!m.touched && m.broken == 0 && m.yielded == 0) return Outcome::original;
  if (m.largest < smash_largest) return Outcome::smash;
  if (m.largest < disunion_largest || m.second >= disunion_second) return Outcome::disunion;
  if (m.cut >= crack_cut) return Outcome::crack;
  if (m.yielded >= crush_yielded || m.shape >= crush_shape) return Outcome::crush;
  return Outcome::restitution;
}

OutcomeMeasures measure_outcome(const BodyModel& moving, const Fragments* fragments,
                                const BodyCounts& counts) {
  const Body& body = moving.body();
  OutcomeMeasures m;
  m.touched = moving.touched();
  if (counts.elements > 0)
    m.broken = 1 - static_cast<double>(counts.live_elements) / static_cast<double>(counts.elements);
  if (m.broken > 0)
    m.cut = static_cast<double>(counts.elements - counts.live_elements) /
            static_cast<double>(middle_section(body));
  m.yielded = static_cast<double>(counts.yielded_masses) / static_cast<double>(body.n_nodes());
  const double size = radius_of_gyration(body);
  double shape = counts.shape_rms;
  if (fragments != nullptr) {
    const auto pieces = measure_fragments(moving, *fragments);
    double mass = 0;
    for (const auto& piece : pieces) mass += piece.mass;
    m.fragments = fragments->count();
    m.largest = pieces[0].mass / mass;
    m.second = pieces.size() > 1 ? pieces[1].mass / mass : 0;
    shape = fragment_shape_rms(moving, *fragments, pieces[0].label);
  }
  m.shape = size > 0 ? shape / size : 0;
  return m;
}

}  // namespace palpate::physics
