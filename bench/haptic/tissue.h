#pragma once
// The physics side of a trial: one mass on a spring, whose surface is z = 0 at rest and faces up.
//
//   m z'' = -k z - b z' - F,    F the hand's force as reported, through a first-order low pass of 5 Hz
//
// A Norton equivalent tells where the surface would be without that force, z + F / k, and k.
// Source: the rule by which physics couples to a tool.

#include <cstdint>

#include "bench/haptic/models.h"
#include "common/message/messages.h"

namespace palpate::bench {

enum class PlaneKind {
  norton,  // plane at zero force, stiffness of the tissue
  raw      // deflected surface, as if it did not give; the force on the tissue is not low-passed
};

class Tissue {
 public:
  static constexpr double force_cutoff_Hz = 5.0;

  Tissue(const ObjectModel& object, PlaneKind kind) noexcept : object_(object), kind_(kind) {}

  /// The force that the hand is known to feel now, along z [N].
  void take(double force) noexcept { reported_ = force; }
  void advance(double dt) noexcept;

  /// Moves the whole object: a pulse, or a jump [m].
  void set_base(double z) noexcept { base_ = z; }

  double base() const noexcept { return base_; }          // [m]
  double surface() const noexcept { return base_ + z_; }  // [m]
  double load() const noexcept { return load_; }          // that it bears [N]
  /// A square of 2 x 40 mm side in two triangles.
  ContactPatch patch(std::uint64_t tick) const noexcept;

 private:
  ObjectModel object_;
  PlaneKind kind_;
  double base_ = 0, z_ = 0, v_ = 0;
  double reported_ = 0, load_ = 0;
};

/// Flat facets that face +z: corners at `surface`, plane at `plane`.
ContactPatch flat_square(std::uint64_t tick, double surface, double plane, double stiffness) noexcept;

}  // namespace palpate::bench
