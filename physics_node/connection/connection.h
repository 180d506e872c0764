#pragma once
// Strands that join two bodies while a scene runs: they pull where they are longer than at rest, and tear.
//
// They act in the step whose elements have just moved the nodes, by where the nodes were when it began, as elements
// do. Their energy is that of the leapfrog, U + dt / 2 times the power of their forces with the velocities before:
// see step/lattice/element_step.h.

#include <cstdint>
#include <vector>

#include "physics_node/connection/strands.h"
#include "physics_node/step/body_model.h"
#include "physics_node/step/good_state.h"

namespace palpate::physics {

class Connection {
 public:
  /// @param from, to  which outlive this
  Connection(std::vector<Strand> strands, BodyModel& from, BodyModel& to);

  /// Before the step of dt: what is torn now, and forces. Allocates nothing.
  void find_forces(double dt) noexcept;
  /// Gives them to both bodies, whose elements have moved the nodes on.
  void act(double dt) noexcept;

  /// Elastic energy as the ledger has it when the last step began; and now, before the next [J].
  double watched() const noexcept { return watched_; }
  double energy() const noexcept;
  /// What torn strands have taken since the start: toughness times area, where as much moved their ends apart [J].
  double broken() const noexcept { return broken_; }
  std::int64_t n_torn() const noexcept { return n_torn_; }
  std::int64_t n_strands() const noexcept { return static_cast<std::int64_t>(strands_.size()); }
  double pull() const noexcept { return pull_; }  // sum of the sizes of their forces in the last step [N]
  const std::vector<Strand>& strands() const noexcept { return strands_; }
  bool is_torn(std::size_t strand) const noexcept { return torn_[strand] != 0; }

  void save(bool good) noexcept;
  void restore() noexcept;
  void reset() noexcept;
  std::uint64_t hash(std::uint64_t seed) const noexcept;

 private:
  struct Torn {
    std::vector<std::uint8_t> of;
    double broken = 0;
    std::int64_t n = 0;
  };
  /// Towards the foot: how much longer than at rest, and which way.
  struct Now {
    double longer = 0;
    Vec3 u = Vec3::Zero();
  };
  Now now(const Strand& strand) const noexcept;
  double power(const Strand& strand, const Vec3& force) const noexcept;

  std::vector<Strand> strands_;
  BodyModel* from_;
  BodyModel* to_;
  std::vector<std::uint8_t> torn_;
  std::vector<NodalForce> on_from_, on_to_;
  double watched_ = 0, broken_ = 0, pull_ = 0, dt_before_ = 0;
  std::int64_t n_torn_ = 0;
  GoodState<Torn> saved_;
};

}  // namespace palpate::physics
