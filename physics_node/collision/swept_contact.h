#pragma once
// Contact by which nothing tunnels: masses against facets, along the whole step.

#include <span>

#include "physics_node/collision/contact_impulses.h"
#include "physics_node/collision/near_pairs.h"

namespace palpate::physics {

struct SweptReport {
  std::int64_t collisions = 0;
  std::int64_t stopped = 0;    // masses that no impulse could keep apart and that were made to move together
  std::int64_t overflows = 0;  // pairs that found no room
  double lost = 0;             // kinetic energy [J]
};

/// One step of contact: impulses at its beginning, which change what the masses move by in it.
///
/// For each pair, with q the point of the facet nearest to mass p, weights w_k, d = |p - q|, n = (p - q) / d:
///   h = (edge + L) / (2 sqrt 3);  v_n = n . (v_p - sum w_k v_k);  W = 1/m_p + sum w_k^2 / m_k
///   d + dt v_n < h and v_n < 0:   J = rebound(e, v_n) / W on p, -w_k J on the corners
/// over all pairs in order, until none approaches or eight times; in every other step in the opposite order, since the first of those that
/// share a mass takes most. Where another facet of the same surface is nearer to p and holds q, J = 0 (collision/shadowed.h). The force
/// acts along the line between the two points, so momentum and angular momentum are kept.
///
/// Then every pair is followed along the step (comes_nearer). Where a mass would still come nearer than a tenth of what it was,
/// the four masses are made to move together, with what they touch, at the velocity of their common momentum: they keep their
/// distance whatever happens. So a mass that begins on one side of a facet ends on that side.
/// Source: Bridson, Fedkiw, Anderson 2002 (impulses first, zones that move together last).
/// Deviation: zones move without rotation; their angular momentum is not kept. They are counted in `stopped`.
class SweptContact {
 public:
  explicit SweptContact(const std::vector<ContactBody>& bodies, std::size_t most_pairs);
  /// @param near  made anew where a mass becomes so fast that the lists do not tell all that it may touch
  SweptReport step(std::vector<ContactBody>& bodies, NearPairs& near, double e, double dt,
                   ContactImpulses& impulses) noexcept;
  void restart() noexcept { backwards_ = false; }

 private:
  enum class Shadow : std::uint8_t { unknown, none, in_it };  // is_shadowed
  struct Active {
    std::array<PairEnd, 4> end{};  // the mass, then the corners
    Vec3 weight = Vec3::Zero();
    Vec3 n = Vec3::UnitZ();
    double distance = 0, h = 0;
    double W = 0;
    Shadow shadow = Shadow::unknown;
    bool together = false;  // in a zone: keeps its distance from now on
  };
  void find_active(const std::vector<ContactBody>& bodies, std::span<Link> links, double dt) noexcept;
  void expect_speeds(const std::vector<ContactBody>& bodies) noexcept;
  bool expect_hits(const std::vector<ContactBody>& bodies, const NearPairs& near, double dt) noexcept;
  void forget_speeds(const std::vector<ContactBody>& bodies) noexcept;
  bool outran(std::vector<ContactBody>& bodies, NearPairs& near, const ContactImpulses& impulses,
              double dt) noexcept;
  double expected_of(PairEnd mass, PairEnd facet, const Facets::Corners& k) const noexcept;
  void look_at(const std::vector<ContactBody>& bodies, NearPair& pair, double travel, double closing,
               double dt) noexcept;
  std::int64_t push_apart(const std::vector<ContactBody>& bodies, double e, double dt,
                          ContactImpulses& impulses, double& lost) noexcept;
  bool would_pass(const std::vector<ContactBody>& bodies, const Active& pair, double dt,
                  const ContactImpulses& impulses) const noexcept;
  void join(const Active& pair) noexcept;
  std::uint32_t zone_of(std::uint32_t id) noexcept;
  std::uint32_t id_of(PairEnd at) const noexcept { return first_[at.body] + at.n; }
  void move_zones_together(const std::vector<ContactBody>& bodies, ContactImpulses& impulses) noexcept;

  std::vector<std::uint32_t> first_;
  // Of each candidate, against its body: pairs are looked for as if it were not faster; 0 of those that are
  // in no list, and between steps [m/s]
  std::vector<double> speed_;
  std::vector<std::span<const double>> speeds_;  // the same by body
  bool widened_ = false;                         // lists were made anew in this step
  std::vector<Active> active_;
  bool backwards_ = false;  // goes over the pairs in the last step
  std::int64_t overflows_ = 0;
  std::vector<std::uint32_t> parent_;  // of each candidate, in zones; itself where it is in none
  std::vector<PairEnd> zoned_;         // candidates in zones
  std::vector<std::uint8_t> in_zone_;
  struct Sum {
    Vec3 momentum = Vec3::Zero();
    double mass = 0;
    bool fixed = false;
    Vec3 velocity = Vec3::Zero();
    Vec3 given = Vec3::Zero();  // impulse to all its masses [N s]
  };
  std::vector<Sum> sums_;  // by candidate, meaningful for roots of zones
};

}  // namespace palpate::physics
