#include "bench/haptic/tissue.h"

#include <numbers>

namespace palpate::bench {

ContactPatch flat_square(std::uint64_t tick, double surface, double plane, double stiffness) noexcept {
  constexpr double a = 0.04;
  ContactPatch patch;
  patch.tick = tick;
  patch.contact_set = 1;
  patch.n_facets = 2;
  patch.facets[0].corners = {{{-a, -a, surface}, {a, -a, surface}, {a, a, surface}}};
  patch.facets[1].corners = {{{-a, -a, surface}, {a, a, surface}, {-a, a, surface}}};
  for (PatchFacet* facet : {&patch.facets[0], &patch.facets[1]}) {
    facet->point = {0, 0, plane};
    facet->normal = {0, 0, 1};
    facet->stiffness = stiffness;
  }
  return patch;
}

void Tissue::advance(double dt) noexcept {
  if (kind_ == PlaneKind::raw)
    load_ = reported_;
  else
    load_ += (reported_ - load_) * dt / (dt + 1.0 / (2 * std::numbers::pi * force_cutoff_Hz));
  if (object_.mass <= 0) return;
  v_ += dt / object_.mass * (-object_.stiffness * z_ - object_.damping * v_ - load_);
  z_ += dt * v_;
}

ContactPatch Tissue::patch(std::uint64_t tick) const noexcept {
  const bool gives = object_.mass > 0;
  if (!gives || kind_ == PlaneKind::raw) return flat_square(tick, surface(), surface(), rigid_stiffness);
  return flat_square(tick, surface(), surface() + load_ / object_.stiffness, object_.stiffness);
}

}  // namespace palpate::bench
