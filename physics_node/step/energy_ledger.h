#pragma once
// Where the energy of a scene went.

namespace palpate::physics {

/// All in J. What was there at the start and what tools put in must be there now or be booked as lost.
struct EnergyLedger {
  double kinetic = 0;        // now: sum of m v(-) . v(+) / 2, see element_step.h
  double elastic = 0;        // now; recoverable
  double gravitational = 0;  // now; 0 at rest
  double dissipated = 0;     // by dampers and drag
  double plastic = 0;        // by yielding
  double numerical = 0;      // to the way time is stepped; either sign
  double broken = 0;         // elastic energy of elements when they broke
  double contact = 0;        // in collisions with a restitution below 1
  double cut = 0;            // by tools that part tissue: toughness times area
  double tool_work = 0;      // done by tools on tissue
  double guard = 0;          // taken out where the guard restored a state
  double start = 0;          // kinetic + elastic + gravitational at the start
  double exchanged =
      0;  // kinetic and elastic at the start, |work| of tools, most work of gravity: what the error goes by

  /// start + tool_work - dissipated - plastic - numerical - broken - contact - cut - guard - (kinetic + elastic + gravitational)
  double missing() const {
    const double lost = dissipated + plastic + numerical + broken + contact + cut + guard;
    return start + tool_work - lost - kinetic - elastic - gravitational;
  }
  /// |missing| over exchanged. Where less than a picojoule was exchanged, over a picojoule: then nothing moves that one could see,
  /// but what comes from nowhere still shows.
  double balance_error() const {
    const double off = missing() < 0 ? -missing() : missing();
    return off / (exchanged > negligible ? exchanged : negligible);
  }
  static constexpr double negligible = 1e-12;  // [J]
};

}  // namespace palpate::physics
