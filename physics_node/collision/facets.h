#pragma once
// The facets of a body that others may run into: triangles of candidates whose elements live and that are not inside the
// tissue. A candidate in no such triangle, as a loose mass, is a facet whose three corners are itself.

#include <array>
#include <vector>

#include "physics_node/boundary/exposed_triangles.h"
#include "physics_node/collision/candidates.h"

namespace palpate::physics {

class Facets {
 public:
  explicit Facets(const Candidates& candidates);

  /// Finds them anew, from the elements alive now: one pass over the candidates. Allocates nothing.
  void restart(const Candidates& candidates) noexcept;

  using Corners = std::array<std::uint32_t, 3>;  // numbers of candidates
  const std::vector<Corners>& all() const { return facets_; }
  bool is_loose(std::uint32_t candidate) const { return in_facet_[candidate] == 0; }

 private:
  ExposedTriangles triangles_;
  std::vector<Corners> facets_;
  std::vector<std::uint8_t> in_facet_;  // of each candidate
};

}  // namespace palpate::physics
