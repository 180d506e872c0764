#pragma once
// A body and its state behind one door, whatever the precision. Virtual calls are per body and stage, never per mass.

#include <cmath>
#include <cstdint>
#include <memory>
#include <span>

#include "physics_node/body/body.h"
#include "physics_node/step/element_step.h"
#include "physics_node/step/fresh_breaks.h"
#include "physics_node/step/implicit_step.h"
#include "physics_node/step/mass_flags.h"
#include "physics_node/step/momentum_account.h"

namespace palpate::physics {

struct NodalForce {
  Index cell = 0;
  Vec3 force = Vec3::Zero();  // [N]
};

/// All in SI; energies in J.
struct Energies {
  double kinetic = 0;
  double between = 0;        // kinetic as the ledger has it: sum of m v(-) . v(+) / 2, see element_step.h
  double elastic = 0;        // recoverable
  double gravitational = 0;  // relative to the rest position
};

/// What elements have given away since the start; never comes back.
struct Losses {
  double viscous = 0;        // in dampers and drag [J]
  double plastic = 0;        // in yielding [J]
  double numerical = 0;      // to the way time is stepped; with the explicit integrators of either sign [J]
  double broken = 0;         // elastic energy of elements when they broke [J]
  std::int64_t breaks = 0;   // elements
};

/// What the last watched step saw; cheap. A number that is not finite anywhere in the body makes `energy()` not finite.
struct Watch {
  double kinetic = 0;  // [J]
  double between = 0;  // as in Energies, before the step [J]
  double elastic = 0;  // before the step [J]
  double fallen = 0;   // energy that gravity has given since the start [J]
  double fallen_before = 0;  // the same before the step [J]
  double speed = 0;    // of the fastest mass [m/s]

  double energy() const { return kinetic + elastic; }
  bool is_finite() const { return std::isfinite(kinetic + elastic + fallen); }
};

/// A fixed plane; tissue stays where n . x >= height.
struct Plane {
  Vec3 n = Vec3::UnitZ();
  double height = 0;  // [m]
};
struct Bounces {
  std::int64_t masses = 0;
  double lost = 0;  // kinetic energy [J]
};

struct BodyCounts {
  std::int64_t elements = 0;  // at the start
  std::int64_t live_elements = 0;
  std::int64_t yielded_masses = 0;
  double max_stretch = 1;  // largest l / L of a live element
  double shape_rms = 0;    // root mean square distance to the rest shape after the best rigid fit [m]
};

class MovingBody {
 public:
  virtual ~MovingBody() = default;
  virtual const Body& body() const noexcept = 0;

  // --- stages of a step ---
  /// An explicit step: forces of all elements, yield and break, motion. @return elements broken
  virtual std::int64_t element_forces_and_integrate(const ExplicitStep& step) noexcept = 0;
  /// A step of backward_euler under these forces; only for bodies made for it. @return what the solver needed
  virtual ImplicitReport implicit_step(const ExplicitStep& step, std::span<const NodalForce> forces) noexcept = 0;
  /// Of forces on masses that nothing holds, with the velocities that moved them. Their work in an explicit step of dt is dt times
  /// the mean of this before it and when all is done that acts in it. [W]
  virtual double power(std::span<const NodalForce> forces) const noexcept = 0;
  /// Adds forces that act during the step just integrated. Held masses ignore them; sleeping rows wake.
  virtual void kick(std::span<const NodalForce> forces, double dt) noexcept = 0;
  /// Makes room for ExplicitStep::exact; once, while loading.
  virtual void prepare_books() = 0;
  /// Makes room for remember_velocities() and the exact books; once, while loading.
  virtual void prepare_contact() = 0;
  /// Before a step in which something may touch: so that contact knows the velocities at its beginning. See read().
  virtual void remember_velocities() noexcept = 0;
  /// An impulse at the beginning of the step just integrated: adds dv to the velocity of a mass and dt dv to its place. A held
  /// mass stays; a sleeping one wakes. With backward_euler, whose step is solved as a whole, contact acts at its end instead:
  /// an impulse changes the velocity only, and read() and bounce_off() tell of the end.
  virtual void push(Index cell, const Vec3& dv, double dt) noexcept = 0;
  /// Masses that were behind the plane when the step began, and approached it, are reflected: v_n := -e v_n.
  /// @return how many, and the kinetic energy that the plane took
  virtual Bounces bounce_off(const Plane& plane, double e, double dt) noexcept = 0;
  /// Lets quiet rows sleep and disturbed ones wake, from what the last watched step saw.
  /// @param frame_seconds  since the last call
  virtual void sleep_and_wake(double frame_seconds) noexcept = 0;
  virtual void wake_all() noexcept = 0;
  /// Fraction of the masses that sleep.
  virtual double sleeping_fraction() const noexcept = 0;

  // --- guard ---
  virtual bool is_finite() const noexcept = 0;
  virtual Watch watch() const noexcept = 0;
  /// Remembers the state. Only the next call says whether it was good, since trouble shows later than it begins: `good`
  /// makes the state of the last call the one to go back to.
  virtual void save(bool good) noexcept = 0;
  virtual void restore() noexcept = 0;  // goes back to the last good state, at rest
  virtual void reset() noexcept = 0;    // as loaded
  /// Puts one mass where a test, a benchmark or a tool wants it. A held mass stays.
  virtual void place(Index cell, const Vec3& displacement, const Vec3& velocity) noexcept = 0;

  // --- answers ---
  virtual Vec3 position(Index cell) const noexcept = 0;
  virtual Vec3 displacement(Index cell) const noexcept = 0;  // from rest [m]
  virtual Vec3 velocity(Index cell) const noexcept = 0;
  virtual Mask mask(Index cell) const noexcept = 0;
  /// Some masses at the beginning of the step just integrated, all in one call: place x, velocity v, and the velocity v_move
  /// at which it moved them. With the explicit integrators v is the mean of v_move before and after the elements acted, so
  /// that an impulse that keeps the energy of v keeps the energy that the integrator keeps.
  /// @param which  of the others, which are as long as each other; @param rest  their rest positions
  virtual void read(std::span<const std::uint32_t> which, std::span<const Index> cells, std::span<const Vec3> rest, double dt, std::span<Vec3> x,
                    std::span<Vec3> v, std::span<Vec3> v_move) const noexcept = 0;
  /// Live elements of every storage cell, as bits  (n_cells)
  virtual std::span<const Mask> masks() const noexcept = 0;
  /// Elements that broke in the last step, in storage order; what breaks next makes the span another one.
  virtual std::span<const Break> fresh_breaks() const noexcept = 0;
  /// The list is not all: anything may have changed. After a reset and a restore at once and still after the next step, and
  /// after a step in which more broke than the list holds. Never where nothing yields.
  virtual bool fresh_overflow() const noexcept = 0;
  /// Elements broken since the start.
  virtual std::int64_t breaks() const noexcept = 0;
  virtual std::uint8_t flags(Index cell) const noexcept = 0;
  /// How many of a mass's live elements have yielded, [0, 1]; of a mass without any, whether one had before it broke.
  virtual double yielded_share(Index cell) const noexcept = 0;
  virtual Energies energies(const Vec3& gravity) const = 0;
  /// What the next step will book at once, of what `energies` has as done: the kick of the dampers and fresh yielding.
  virtual Losses due() const = 0;
  virtual Losses losses() const = 0;
  virtual Momenta momenta() const = 0;
  /// Has anything pushed or hit it since it was loaded or reset?
  virtual bool touched() const noexcept = 0;
  /// Begins the books of momentum with what there is now.
  virtual void restart_momentum() noexcept = 0;
  /// Where impulses from outside that no member here gives are booked.
  virtual MomentumAccount& momentum_account() noexcept = 0;
  /// What the books of momentum miss; means nothing where masses are held or dampers are not axial.
  virtual MomentumBalance momentum_balance() const = 0;
  virtual BodyCounts counts() const = 0;
  /// Hash of displacement, velocity, live elements and plastic state of all masses, continued from `seed`.
  virtual std::uint64_t hash(std::uint64_t seed) const noexcept = 0;
};

std::unique_ptr<MovingBody> make_moving_body(Body body, Precision precision,
                                             Integrator integrator = Integrator::symplectic_euler);

}  // namespace palpate::physics
