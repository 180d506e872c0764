#pragma once
// What a body has of energy and momentum, and where it went.

#include <cmath>
#include <cstdint>
#include <optional>

#include "physics_node/step/momentum_account.h"

namespace palpate::physics {

/// All in SI; energies in J.
struct Energies {
  double kinetic = 0;
  double between = 0;        // kinetic as the ledger has it: sum of m v(-) . v(+) / 2, see element_step.h
  double elastic = 0;        // recoverable
  double gravitational = 0;  // relative to the rest position
};

/// What elements have given away since the start; never comes back.
struct Losses {
  double viscous = 0;       // in dampers and drag [J]
  double plastic = 0;       // in yielding [J]
  double numerical = 0;     // to the way time is stepped; with the explicit integrators of either sign [J]
  double broken = 0;        // elastic energy of elements when they broke [J]
  std::int64_t breaks = 0;  // elements

  Losses& operator+=(const Losses& more) noexcept {
    viscous += more.viscous;
    plastic += more.plastic;
    numerical += more.numerical;
    broken += more.broken;
    breaks += more.breaks;
    return *this;
  }
  Losses operator-(const Losses& less) const noexcept {
    return {viscous - less.viscous, plastic - less.plastic, numerical - less.numerical, broken - less.broken,
            breaks - less.breaks};
  }
};

/// What the last watched step saw; cheap. A number that is not finite anywhere in the body makes `energy()` not finite.
struct Watch {
  double kinetic = 0;        // [J]
  double between = 0;        // as in Energies, before the step [J]
  double elastic = 0;        // before the step [J]
  double fallen = 0;         // energy that gravity has given since the start [J]
  double fallen_before = 0;  // the same before the step [J]
  double speed = 0;          // of the fastest mass [m/s]

  double energy() const { return kinetic + elastic; }
  bool is_finite() const { return std::isfinite(kinetic + elastic + fallen); }
};

struct BodyCounts {
  std::int64_t elements = 0;  // at the start
  std::int64_t live_elements = 0;
  std::int64_t yielded_masses = 0;
  double max_stretch = 1;                // largest l / L of a live element
  std::optional<double> least_corner_J;  // of all steps so far: see StepOutcome; only of cells
  double shape_rms = 0;  // root mean square distance to the rest shape after the best rigid fit [m]
};

class Books {
 public:
  virtual ~Books() = default;

  virtual Watch watch() const noexcept = 0;
  virtual Energies energies(const Vec3& gravity) const = 0;
  /// Kinetic and elastic energy as they are now. Cost: a pass over all elements. Contract: takes no memory. [J]
  virtual double energy_now() const noexcept = 0;
  /// What the next step will book at once, of what `energies` has as done: the kick of the dampers and fresh yielding.
  virtual Losses due() const = 0;
  virtual Losses losses() const = 0;
  virtual Momenta momenta() const = 0;
  /// Has anything pushed or hit it since it was loaded or reset?
  virtual bool touched() const noexcept = 0;
  /// Begins the books of momentum with what there is now.
  virtual void restart_momentum() noexcept = 0;
  /// What the books of momentum miss; means nothing where masses are held or dampers are not axial.
  virtual MomentumBalance momentum_balance() const = 0;
  virtual BodyCounts counts() const = 0;
  /// Hash of displacement, velocity, live elements and plastic state of all masses, continued from `seed`.
  virtual std::uint64_t hash(std::uint64_t seed) const noexcept = 0;
};

}  // namespace palpate::physics
