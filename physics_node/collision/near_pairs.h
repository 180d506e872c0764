#pragma once
// What could touch soon: a list of pairs within reach plus a skin, made anew only when something moved by half the skin.
// Until then a step looks at these pairs and at nothing else. Source: Verlet 1967 (neighbour lists with a skin).
//
// There are lists of (mass, mass) and of (mass, facet); each pair comes once, in one fixed order.
// Joined masses are no pair, nor is a mass with a facet that it is joined to.

#include <cstdint>
#include <span>
#include <vector>

#include "physics_node/collision/contact_body.h"
#include "physics_node/collision/point_grid.h"

namespace palpate::physics {

/// A candidate or a facet: which body, which number there.
struct PairEnd {
  std::uint32_t body = 0, n = 0;
};
struct NearPair {
  PairEnd mass, other;  // other: a mass or a facet
};
enum class PairKind { masses, facets, both };

class NearPairs {
 public:
  NearPairs(const std::vector<ContactBody>& bodies, PairKind kind);

  /// Which bodies may touch which, this frame; a body beside itself: its fragments.
  void allow(std::uint32_t a, std::uint32_t b, bool near) noexcept;

  /// Brings the lists up to date with where the candidates are now, after a step of dt.
  /// @param changed  candidates or facets are not what they were when they were made
  void update(std::vector<ContactBody>& bodies, bool changed, double dt) noexcept;

  const std::vector<NearPair>& masses() const { return masses_; }  // (mass, mass)
  const std::vector<NearPair>& facets() const { return facets_; }  // (mass, facet)
  std::int64_t rebuilds() const { return rebuilds_; }
  std::int64_t overflows() const { return overflows_; }  // pairs that found no room

 private:
  bool is_allowed(std::uint32_t a, std::uint32_t b) const { return allowed_[a * n_bodies_ + b] != 0; }
  double skin(const Candidates& a, const Candidates& b) const noexcept;  // [m]
  bool is_valid(const std::vector<ContactBody>& bodies) const noexcept;
  void rebuild(const std::vector<ContactBody>& bodies) noexcept;
  void choose_seekers(const std::vector<ContactBody>& bodies) noexcept;
  void seek_masses(const std::vector<ContactBody>& bodies) noexcept;
  void seek_facets(const std::vector<ContactBody>& bodies) noexcept;
  void add(std::vector<NearPair>& list, PairEnd mass, PairEnd other) noexcept;
  /// Masses of a body near a facet.
  void seek_masses_near(const std::vector<ContactBody>& bodies, PairEnd facet, std::uint32_t other) noexcept;

  std::uint32_t n_bodies_;
  PairKind kind_;
  std::vector<std::uint8_t> allowed_;  // (n_bodies, n_bodies)
  std::vector<std::uint32_t> first_;   // id of the first candidate of each body, as first_candidates()
  // Of each candidate: may it meet another body, may it meet its own?
  std::vector<std::uint8_t> seeks_other_, seeks_own_;
  std::vector<PointGrid> grids_;             // of each body
  std::vector<Eigen::AlignedBox3d> boxes_;   // of each body
  std::vector<Eigen::AlignedBox3d> movers_;  // of each body, round the candidates that may meet their own
  double smallest_L_ = 0, largest_L_ = 0;
  double least_skin_ = 0;  // for what one step moves masses by [m]
  std::vector<NearPair> masses_, facets_;
  std::int64_t rebuilds_ = 0, overflows_ = 0;
  bool fresh_ = false;
};

/// What two masses may move towards each other in a step at most, where the fastest has this speed: a light one that a heavy
/// one hits goes on at twice its speed, and a little more is allowed for [m].
double most_motion(double dt, double speed) noexcept;
/// Distance at which two masses of these bodies touch, at rest: the larger L / sqrt(3). (EQUATIONS C-13)
double paper_distance(const Candidates& a, const Candidates& b) noexcept;
/// Distance at which a mass touches a facet whose edges now have this mean length: (edge + L) / (2 sqrt(3)), which is
/// L / sqrt(3) between equal lattices at rest. A loose mass counts as one with edges of L.
double swept_distance(double edge, const Candidates& of_mass) noexcept;

}  // namespace palpate::physics
