#pragma once
// Finds the masses and facets of two bodies, or of one, that are within reach of each other. Skips what lies outside the
// box of the other body; of a body with itself, what has not moved from its place and what is neither torn nor come off.

#include <array>
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
  double look_at = 0;   // when so much has been travelled that they could touch [m]
};

/// How much farther apart than where they touch pairs are listed: skin + between + what the mass and the
/// other have been given; of a facet, its corner that has most [m].
struct ListReach {
  double skin = 0, between = 0;
  std::span<const double> of_a, of_b;  // by candidate of the two bodies; empty: nothing
};

/// With room made once; what finds none is counted.
class PairList {
 public:
  void make_room(std::size_t n) { pairs_.reserve(n); }
  /// For sort_by_mass(), too. @param n_masses  of both bodies, at most
  void make_room(std::size_t n, std::size_t n_masses) {
    make_room(n), by_mass_.reserve(n), begin_.reserve(n_masses + 1);
  }
  void clear() noexcept { pairs_.clear(); }
  void add(PairEnd mass, PairEnd other) noexcept;
  void sort() noexcept;
  /// The same of pairs that were added in the order of what is not the mass: a pass to count, and one to put in place.
  /// @param a, n_a  the smaller body, and its masses; @param n  masses of both
  void sort_by_mass(std::uint32_t a, std::size_t n_a, std::size_t n) noexcept;

  std::vector<NearPair>& pairs() { return pairs_; }
  const std::vector<NearPair>& pairs() const { return pairs_; }
  std::int64_t overflows() const { return overflows_; }

 private:
  std::vector<NearPair> pairs_, by_mass_;
  std::vector<std::uint32_t> begin_;  // of each mass, in order
  std::int64_t overflows_ = 0;
};

class PairSearch {
 public:
  explicit PairSearch(const std::vector<ContactBody>& bodies);

  /// Lists (mass, mass) pairs, each once, sorted. Joined masses are no pair.
  /// @param a, b  a <= b; a == b: a body with itself
  void find_masses(const std::vector<ContactBody>& bodies, std::uint32_t a, std::uint32_t b,
                   const ListReach& reach, PairList& list) noexcept;
  /// Lists (mass, facet) pairs either way, each once, sorted. A mass is no pair with a facet that it is joined to.
  void find_facets(const std::vector<ContactBody>& bodies, std::uint32_t a, std::uint32_t b,
                   const ListReach& reach, PairList& list) noexcept;

 private:
  void choose(const std::vector<ContactBody>& bodies, std::uint32_t a, std::uint32_t b, double touch,
              const ListReach& reach) noexcept;
  void choose_movers(const ContactBody& body, std::uint32_t b) noexcept;
  void choose_inside(const ContactBody& body, std::uint32_t b, const Eigen::AlignedBox3d& box) noexcept;
  void seek_masses_near(const std::vector<ContactBody>& bodies, PairEnd facet, std::uint32_t other,
                        double skin, PairList& list) const noexcept;

  // Of each body, as chosen last:
  struct Side {
    std::vector<std::uint8_t> seeks;  // of each candidate: may it meet the other?
    Eigen::AlignedBox3d box;          // round those that do
    PointGrid grid;                   // of those that may be met, on levels by what they were given
    std::span<const double> given;    // to each [m]
    double little = 0;                // to those on level 0, at most; on each further one twice as much [m]
    std::array<double, PointGrid::levels> most{};  // given to any on a level [m]
    double most_of_all = 0;

    double given_to(std::size_t n) const noexcept { return n < given.size() ? given[n] : 0; }
    std::uint32_t level_of(std::size_t n) const noexcept {
      std::uint32_t level = 0;
      for (double up_to = little; level + 1 < PointGrid::levels && given_to(n) > up_to; up_to *= 2) ++level;
      return level;
    }
  };
  std::vector<Side> sides_;
};

/// Distance at which two masses of these bodies touch, at rest: the larger L / sqrt(3). (EQUATIONS C-13)
double paper_distance(const Candidates& a, const Candidates& b) noexcept;
/// Distance at which a mass touches a facet whose edges now have this mean length: (edge + L) / (2 sqrt(3)), which is
/// L / sqrt(3) between equal lattices at rest. A loose mass counts as one with edges of L.
double swept_distance(double edge, const Candidates& of_mass) noexcept;

}  // namespace palpate::physics
