#pragma once
// Strands that join two bodies while a scene runs: they pull where they are longer than at rest, tear, and are cut.
// What has been cut of one pulls no longer: k is as much less.
//
// A damper's work is that of its force, half with the velocities before a step and half with those after it, as of a
// tool's.
//
// They act in the step whose elements have just moved the nodes, by where the nodes were when it began, as elements
// do. Their energy is that of the leapfrog, U + dt / 2 times the power of their forces with the velocities before:
// see step/lattice/element_step.h.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "physics_node/connection/strands.h"
#include "physics_node/step/body_model.h"
#include "physics_node/step/good_state.h"

namespace palpate::physics {

class Connection {
 public:
  /// @param from, to  which outlive this
  Connection(std::vector<Strand> strands, BodyModel& from, BodyModel& to);

  /// After a step in which nodes of the second body may have split: strands stay on the tetrahedra that they end on.
  /// Allocates nothing.
  void follow() noexcept;

  /// Before the step of dt: what is torn now, and forces. Allocates nothing.
  void find_forces(double dt) noexcept;
  /// Gives them to both bodies, whose elements have moved the nodes on.
  void act(double dt) noexcept;

  /// Of a tool that follows steps: forces on the masses at the ends, in the step whose elements have just moved them.
  void kick(std::span<const StrandPush> pushes, double dt) noexcept;
  double power(std::span<const StrandPush> pushes) const noexcept;  // of these, with velocities now [W]
  /// Cuts as much as they say. @return what that had held and has lost [J]
  double cut(std::span<const StrandPush> pushes) noexcept;

  /// Where a strand begins and ends now [m], and how fast [m/s].
  struct Ends {
    Vec3 node = Vec3::Zero(), foot = Vec3::Zero();
  };
  Ends places(const Strand& strand) const noexcept;
  Ends velocities(const Strand& strand) const noexcept;
  /// What a cut that begins at the strand would release by the share that it cuts [J].
  double stored_by_share(std::size_t strand) const noexcept;
  double inverse_mass_of_node(const Strand& strand) const noexcept;  // [1/kg]
  double inverse_mass_of_foot(const Strand& strand, std::size_t corner) const noexcept;

  /// Elastic energy as the ledger has it when the last step began; and now, before the next [J].
  double watched() const noexcept { return watched_; }
  double energy() const noexcept;
  /// What torn strands have taken since the start: toughness times area, where as much moved their ends apart [J].
  double broken() const noexcept { return broken_; }
  /// What dampers have taken, as the ledger has it when the last step began; and by now [J].
  double watched_viscous() const noexcept { return watched_viscous_; }
  double viscous() const noexcept { return viscous_ + due(); }
  std::int64_t n_torn() const noexcept { return n_torn_; }
  std::int64_t n_cut() const noexcept { return n_cut_; }  // through and through
  std::int64_t n_strands() const noexcept { return static_cast<std::int64_t>(strands_.size()); }
  double pull() const noexcept { return pull_; }  // sum of the sizes of their forces in the last step [N]
  const std::vector<Strand>& strands() const noexcept { return strands_; }
  bool holds(std::size_t strand) const noexcept { return left_[strand] > 0; }
  /// Share of it that is neither cut nor torn.
  double left(std::size_t strand) const noexcept { return left_[strand]; }

  void save(bool good) noexcept;
  void restore() noexcept;
  void reset() noexcept;
  /// What is left of strands is remembered, and comes back; once both bodies have come back to theirs (Topology::mark).
  void mark() noexcept { note(marked_); }
  void return_to_mark() noexcept;
  std::uint64_t hash(std::uint64_t seed) const noexcept;

 private:
  /// Where strands end on tetrahedra or triangles that may be cut.
  struct OnElement {
    Index element = 0;
    std::array<std::uint8_t, 3> corner{};
  };
  template <class Visit>
  void with_net(const Visit& visit) const;
  template <class Net>
  void find_elements(const Net& net);
  void take_feet() noexcept;

  struct Left {
    std::vector<double> of;
    double broken = 0, viscous = 0;
    std::int64_t n_torn = 0, n_cut = 0;
  };
  /// Towards the foot: how much longer than at rest, and which way.
  struct Now {
    double longer = 0;
    Vec3 u = Vec3::Zero();
  };
  Now now(std::size_t strand) const noexcept;
  double power(const Strand& strand, const Vec3& force) const noexcept;
  double energy(std::size_t strand) const noexcept;  // of a whole one
  double due() const noexcept;  // the half of the last step's dampers that is still to be booked [J]
  Vec3 damp(std::size_t strand, const Now& at) const noexcept;
  void put(const Strand& strand, const Vec3& on_node, const Vec3& on_foot) noexcept;

  std::vector<Strand> strands_;
  std::vector<Vec3> rest_;  // of each, from its node to its foot; parts of a cut body keep it [m]
  BodyModel* from_;
  BodyModel* to_;
  std::vector<OnElement> on_element_;  // of each strand; EMPTY: of another body
  std::vector<double> left_;
  std::vector<Vec3> damping_;  // in the last step, on the first body [N]
  std::vector<NodalForce> on_from_, on_to_;
  double watched_ = 0, watched_viscous_ = 0, broken_ = 0, viscous_ = 0, pull_ = 0, dt_before_ = 0;
  std::int64_t n_torn_ = 0, n_cut_ = 0;
  void note(Left& to) const noexcept;
  void bring_back(const Left& from) noexcept;

  GoodState<Left> saved_;
  Left marked_;
};

using Connections = std::vector<std::unique_ptr<Connection>>;

}  // namespace palpate::physics
