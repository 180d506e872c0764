#pragma once
// Contact of bodies whose steps are solved, not taken: backward_euler.

#include "physics_node/collision/contact_impulses.h"
#include "physics_node/collision/near_pairs.h"
#include "physics_node/step/pending_step.h"

namespace palpate::physics {

struct JointReport {
  std::int64_t touching = 0;   // pairs
  std::int64_t solves = 0;     // of all near bodies, besides the first
  std::int64_t overflows = 0;  // pairs that found no room
  bool converged = true;
};

/// Pairs of a mass and a facet (or two masses), with weights w of the facet's corners as in SweptContact, d their distance when the step
/// begins and h the one at which they touch. Sought are forces l >= 0 along the line between both, with which the step ends at
///
///   d + dt n . (v_p - sum w_k v_k) >= h,   l = 0 where it is more
///
/// v the velocities with which all bodies, solved with l, move their masses: so each gives way as a whole, not by the masses that touch.
/// What begins nearer than h comes no nearer than it has been since it touched; it is not let out, since to let out is to throw. An iteration sweeps over the pairs as if masses were free,
///   l_i := max(0, l_i + (what is missing) / (dt^2 W_i)),   W = 1/m_p + sum w_k^2 / m_k
/// which never does too much, since what holds masses together makes them heavier; then follows the sweeps' common direction
/// (Fletcher & Reeves, from the start where that grows), and solves the bodies again. Forces begin with those of the last step, so that what
/// rests takes one solve. Restitution is that of the bodies, by their elasticity: masses themselves stay where they meet.
/// Source: Silcowitz, Niebe, Erleben 2010 (nonsmooth non-linear conjugate gradients).
/// Contract: allocates and throws nothing after construction; the same bits on any number of threads.
class JointContact {
 public:
  JointContact(const std::vector<ContactBody>& bodies, std::size_t most_pairs);

  /// Before the bodies are solved: which pairs may touch in the step, and their forces of the last.
  void begin(const std::vector<ContactBody>& bodies, std::span<Link> links, double dt) noexcept;
  /// After a solve, when velocities were read: other forces. @return false: these are the forces
  bool improve(const std::vector<ContactBody>& bodies, double dt) noexcept;
  /// Forces on the masses of a body.
  std::span<const NodalForce> forces(std::size_t body) const noexcept { return forces_[body]; }
  /// At the end: what each body takes.
  JointReport end(const std::vector<ContactBody>& bodies, double dt, ContactImpulses& impulses) noexcept;
  void restart() noexcept { rows_.clear(), last_.clear(); }

 private:
  struct Row {
    std::array<PairEnd, 4> end{};
    Vec3 weight = Vec3::Zero();
    Vec3 n = Vec3::UnitZ();
    double gap = 0, least = 0;                // d - h when the step begins; where it may end [m]
    double W = 0;                             // [1/kg]
    double l = 0, change = 0, direction = 0;  // force, of the last sweep, of conjugate gradients [N]
    std::uint64_t key = 0;
  };
  struct Remembered {
    std::uint64_t key = 0;
    double l = 0, least = 0;  // force [N]; how near it may come [m]
  };
  void find(const std::vector<ContactBody>& bodies, const Link& link, double dt) noexcept;
  void add(Row row, double distance, double h, double reach) noexcept;
  double missing(const std::vector<ContactBody>& bodies, const Row& row, double dt) const noexcept;
  void sweep(const std::vector<ContactBody>& bodies, double dt) noexcept;
  void spread(const std::vector<ContactBody>& bodies) noexcept;
  template <class Visit>
  static void each_end(const Row& row, const Visit& visit) {  // visit(end, its weight)
    visit(row.end[0], 1.0);
    for (int k = 0; k < 3; ++k)
      if (row.weight[k] > 0) visit(row.end[static_cast<std::size_t>(k) + 1], -row.weight[k]);
  }
  std::size_t id_of(PairEnd at) const noexcept { return first_[at.body] + at.n; }

  std::vector<std::uint32_t> first_;
  std::vector<Row> rows_;
  std::vector<Remembered> last_;  // by key
  std::vector<Vec3> dv_;          // by candidate: of a sweep [m/s], or a force [N]; zero between
  std::vector<std::vector<NodalForce>> forces_;  // by body
  double near_enough_ = 0;                       // [m]
  double square_ = 0;                            // of the last change
  int iterations_ = 0;
  bool converged_ = true;
  std::int64_t overflows_ = 0;
};

}  // namespace palpate::physics
