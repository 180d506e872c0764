#pragma once
// A body of which only a part is stepped: what is near to where it is pressed. The rest stands where it rests and costs nothing.

#include <cstdint>
#include <span>
#include <vector>

#include "physics_node/step/awake_parts.h"
#include "physics_node/step/good_state.h"
#include "physics_node/step/lattice/hex_grid.h"
#include "physics_node/step/lattice/pressed_places.h"
#include "physics_node/step/lattice/soft_rim.h"
#include "physics_node/step/lattice/state.h"
#include "physics_node/step/node_motion.h"

namespace palpate::physics {

/// Segments of rows (lattice.h) act that come within SolidElements::awake_radius of a place that is pressed, or within
/// more where there is little tissue (near_runs.h); once they do, until they are three cells further away. Behind them a
/// soft rim follows the places. What falls asleep is put back to where it rests, and what wakes begins
/// where the rim beside it is, the less the further out: u = u_rim r_rim / r. Both are booked as `numerical`. Gravity does not act: the shape
/// is that under gravity, and its weight is balanced everywhere.
/// Cost: of what is awake. At load and after a reset all sleeps.
template <class Real>
class AwakeRegion {
 public:
  explicit AwakeRegion(const Body& body);

  /// Before they act: where it is pressed or pushed, within a step of dt. What is new wakes at once.
  void wake(const Body& body, LatticeState<Real>& state, std::span<const NodalForce> forces) noexcept;
  void wake(const Body& body, LatticeState<Real>& state, std::span<const NodalPush> pushes,
            double dt) noexcept;
  bool moves(Index node) const noexcept { return (marks_[static_cast<std::size_t>(node)] & node_moves) != 0; }
  /// After a cut: what hangs on nothing but cells that rest does not move, and the rim is where cells still hang together.
  void follow_cut(const Body& body, LatticeState<Real>& state, std::span<const NodeSplit> splits) noexcept;
  /// @param seconds  since the last call; 0: a new place was noted
  void look(const Body& body, LatticeState<Real>& state, double seconds) noexcept;
  /// All falls asleep where it rests, as after a reset; what was lost is forgotten.
  void clear(const Body& body, LatticeState<Real>& state) noexcept;

  /// As Stepper::save() and restore(): to rest, with the losses of the last good state.
  void save(bool good, const Losses& all) noexcept { saved_.next(good) = all; }
  void go_back(const Body& body, LatticeState<Real>& state) noexcept;

  SoftRim<Real>& rim() noexcept { return rim_; }
  const SoftRim<Real>& rim() const noexcept { return rim_; }
  std::span<const Index> rows() const noexcept { return rows_; }  // that are awake, in storage order
  Index moving_nodes() const noexcept { return n_moving_; }
  /// Of rows that are awake and that sleep again, of the copies that cuts have made, and of the rim.
  Losses losses(const Body& body, const LatticeState<Real>& state) const noexcept;
  const AwakeParts& parts() const noexcept { return parts_; }

 private:
  void choose(const Body& body) noexcept;
  double settle_nodes(const Body& body, LatticeState<Real>& state) noexcept;
  void begin_near_rim(const Body& body, LatticeState<Real>& state, Index node) noexcept;
  void clear_copies(const Body& body, LatticeState<Real>& state) noexcept;
  void settle_rows(LatticeState<Real>& state) noexcept;
  void put_to_sleep(LatticeState<Real>& state, std::size_t row) noexcept;
  void move_border(const Body& body, LatticeState<Real>& state) noexcept;
  bool settle_split(const Body& body, LatticeState<Real>& state, Index node) noexcept;
  double of_rim(const LatticeState<Real>& state) const noexcept;
  void measure(const Body& body, const LatticeState<Real>& state) noexcept;
  template <class Visit>
  void each_corner(const Body& body, Index run, const Visit& visit) const noexcept;

  HexGrid grid_;
  double radius_;  // [m]
  PressedPlaces places_;
  std::vector<Vec3> border_of_;  // the places that the border was chosen for [m]
  SoftRim<Real> rim_;
  std::vector<std::uint8_t> marks_;             // of each storage cell
  std::vector<Index> acting_, next_, changed_;  // runs, in storage order
  std::vector<Index> rows_;                     // awake, in storage order
  std::vector<std::uint8_t> run_is_, row_is_;   // what becomes of each
  std::vector<Vec3> began_;                     // where nodes that wake begin [m]
  std::vector<Index> waking_;
  Losses slept_;
  GoodState<Losses> saved_;
  double since_ = 0;  // the last look at places [s]
  Index n_moving_ = 0;
  AwakeParts parts_;
};

}  // namespace palpate::physics
