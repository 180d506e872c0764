#pragma once
// A body of tetrahedra that moves: its state, its step and its books. See tet_element.h and tet_layout.h.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "physics_node/mesh/simplex_net.h"
#include "physics_node/step/books.h"
#include "physics_node/step/explicit_step.h"
#include "physics_node/step/fem/tet_kernel.h"
#include "physics_node/step/stepper.h"
#include "physics_node/step/zeroed_array.h"

namespace palpate::physics {

/// Symplectic Euler, and its energy is that of the leapfrog: see lattice/element_step.h. Nothing breaks, and nothing sleeps. The damper
/// is booked by the power that it takes of sixteen tetrahedra at a time, see damper_loss(); between two struck steps by its forces on the nodes, and what these would
/// give in place of taking is `numerical`.
/// Cost: bench/fem.
template <class Real>
class Tetrahedra {
 public:
  using Net = TetNet;

  /// @param model  renumbered; every tetrahedron has a volume and a material
  /// @param set    that this machine runs; avx2 and avx512 give the same bits, sse2 others
  /// @param most_copies  of nodes that cuts may make; of first order
  explicit Tetrahedra(TetModel model, InstructionSet set = instruction_set(), std::size_t most_copies = 0);

  /// A step. Of ExplicitStep: `verlet` and `exact` mean nothing here; struck ones book exactly. Allocates, locks and throws nothing.
  /// @return of what was watched: least J of the tetrahedra; and the largest stiffening of one, by which squared frequencies of the body
  ///   grow by no more but for some percent (6 in 36 bodies strained by up to 0.4 at random), nor, damped, shortens its stable step
  StepOutcome step(const ExplicitStep& step) noexcept { return this->step(step, step.dt); }
  /// @param kick  for which elements act, while nodes move for step.dt: see step/strides.h. The damper then sees how
  ///   nodes have moved since elements acted before: what acts in between shakes them at no mean velocity [s]
  StepOutcome step(const ExplicitStep& step, double kick) noexcept;
  /// Nodes go on as they are for dt; nothing acts. @return as of the last step that was watched
  StepOutcome drift(double dt) noexcept;

  const TetModel& model() const noexcept { return model_; }
  const TetLayout& layout() const noexcept { return layout_; }
  std::size_t n_nodes() const noexcept { return model_.mesh.nodes.size(); }
  /// 0: held [1/kg]
  double inverse_mass(Index node) const noexcept;
  Vec3 displacement(Index node) const noexcept;  // [m]
  Vec3 velocity(Index node) const noexcept;      // [m/s]
  /// Puts a node somewhere, held or not.
  void place(Index node, const Vec3& displacement, const Vec3& velocity) noexcept;
  /// An impulse at the beginning of the step of dt just integrated: v += dv, u += dt dv.
  void push(Index node, const Vec3& dv, double dt) noexcept;
  /// Four numbers of each node: x, y, z and 0.
  const Real* displacements() const noexcept { return u_.data(); }
  const Real* velocities() const noexcept { return v_.data(); }

  /// Where it is, and what it has lost by then.
  struct Saved {
    ZeroedArray<Real> u;
    double viscous = 0, numerical = 0;  // [J]
    Watch watch{};
  };
  Saved saved() const;  // room for it
  void save(Saved& to) const noexcept;
  /// A copy of a node was where that was.
  void copy_saved(Saved& in, Index node, Index copy) const noexcept;
  /// At rest where it was.
  void bring_back(const Saved& from) noexcept;
  /// Begins the books anew: nothing is lost, and no step came before.
  void forget() noexcept;

  /// Gives the net's copies to the tetrahedra that have them there: they begin where the nodes are that they split off from,
  /// as fast, and masses are shared anew. Allocates nothing.
  /// @param splits  since this was last called; all of them
  /// @return by how much elastic energy grows [J]: the mean pressure at a node was of all that now have pressures of
  ///   their own, and what varies more holds more; 0 without nodal pressure
  double separate(std::span<const NodeSplit> splits, const TetNet& net) noexcept;
  /// As loaded, whatever was separated; places and velocities of nodes as loaded stay.
  void rejoin() noexcept;
  /// Of a node, whatever holds it [kg].
  double mass(Index node, const TetNet& net) const noexcept;

  /// Forces on all nodes as they are, at u without the damper, in the precision of the state [N]. (nodes)
  void forces(std::vector<Vec3>& out) noexcept;
  /// What there is now; `between` as the next step finds it with the dt of the last.
  Energies energies(const Vec3& gravity);
  /// Lost in the damper, and to steps of another dt, as of the last watched step.
  Losses losses() const noexcept;
  /// What the next step books of the damper that `losses` do not have yet. Cost: two sweeps.
  Losses due();
  double damper_power();                                       // what the damper takes as it moves now [W]
  double least_J() const noexcept { return least_of_all_J_; }  // of all steps that were watched
  double largest_stretch()
      const;  // of all directions in all tetrahedra; of second order of the eight parts of each
  Watch watch() const noexcept;
  Momenta momenta() const noexcept;  // about the origin
  std::uint64_t hash(std::uint64_t seed) const noexcept;
  bool is_finite() const noexcept;

 private:
  using Four = ZeroedArray<Real>;
  TetContext<Real> context() noexcept;
  template <class Work>
  static void each(const ExplicitStep& step, std::size_t n, const Work& work) noexcept;
  const TetSweep<Real>& sweep() const noexcept { return model_.beta > 0 ? kernel_.damped : kernel_.elastic; }
  void elements(const TetContext<Real>& m, const ExplicitStep& step, const TetSweep<Real>& sweep,
                typename TetSweep<Real>::OfBlock kernel) noexcept;
  void note_way(double kick, double dt) noexcept;
  void write_corner(std::size_t lane, std::size_t corner) noexcept;
  double volume_change(std::size_t tet) const noexcept;
  Real rate_before(Index node, std::size_t material) const noexcept;
  void measure_again(Index node, const TetNet& net) noexcept;
  void find_share_volumes() noexcept;
  double swollen_energy(Index node, const TetNet& net, bool after) noexcept;
  double elastic() const noexcept;        // of what was last asked for [J]
  double lost_by_power() const noexcept;  // from the last step to what was last asked for [J]

  TetModel model_;
  TetLayout layout_;
  std::optional<TetLayout> loaded_;  // what layout_ was, of a body that may be cut
  std::optional<TetLanes> lanes_;
  struct Swollen {
    Index node = 0;
    std::size_t material = 0;
    double volume = 0, change = 0;  // [m^3]
  };
  std::vector<Swollen> swollen_;  // room for those at a node
  std::vector<TetConstants<Real>> constants_;
  ZeroedArray<TetBatch<Real>> batches_;        // of first order
  ZeroedArray<TetBatch<Real, 10>> batches10_;  // of second order
  std::vector<double> stiffness_at_rest_;      // see TetContext
  ZeroedArray<Real> inverse_mass_, share_volume_;
  std::vector<double> share_energy_, volumes_;  // by share
  TetKernel<Real> kernel_;

  Four u_, v_, force_;
  Four rate_force_, seen_rate_;  // see TetContext; only damped
  ZeroedArray<Real> swelling_, mean_, mean_rate_, mean_rate_before_;
  double dt_before_ = 0;  // for which elements acted last [s]
  Four began_, mean_v_;   // of nodes: where elements acted last, and how they have moved since; only damped
  double since_ = 0;      // elements acted for more than a step, and nodes have moved for this long [s]

  std::vector<double> elastic_, stiffest_, least_J_;  // by block: see TetContext
  std::vector<double> elastic_of_shares_;             // by chunk: the same
  std::vector<double> power_, power_before_;  // of batches, then of chunks of shares; and a step ago [W]
  std::vector<double> lost_;                  // in blocks, then in chunks of shares: see TetContext
  bool rate_known_ = false;                   // seen_rate_ is that of the last step
  double z_ = 0;                              // see TetContext
  std::vector<TetNodeLedger> ledger_;         // by chunk
  Watch watch_;
  double passed_ = 0, viscous_ = 0, numerical_ = 0;  // in all; passed_: viscous, of unwatched steps, too [J]
  double stiffening_ = 1, least_of_all_J_ = 1;       // of the last watched step; of all
};

}  // namespace palpate::physics
