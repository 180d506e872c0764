#pragma once
// What has become of a body, in the words of the paper.
//
// Source: Wakamatsu & Honma 2011, section on the fall of a sphere: the state before, and five states after an impact.
// The paper shows pictures and no measure; measures and thresholds are ours (docs/reference/outcomes.md, EQUATIONS C-17, C-18).

#include "physics_node/fragments/fragments.h"
#include "physics_node/step/body_model.h"

namespace palpate::physics {

enum class Outcome { original, restitution, crack, disunion, crush, smash };
inline constexpr const char* outcome_names[] = {"original", "restitution", "crack",
                                                "disunion", "crush",       "smash"};
inline const char* name_of(Outcome outcome) { return outcome_names[static_cast<int>(outcome)]; }

struct OutcomeMeasures {
  bool touched = false;  // by floor, tool or another body, since the start
  double broken = 0;     // share of the elements
  double cut = 0;        // elements broken over those that a plane through the middle cuts (section.h)
  double yielded = 0;    // share of the masses
  int fragments = 1;
  double largest = 1;  // share of mass of the heaviest fragment
  double second = 0;   // of the next; 0 where there is one only
  double shape =
      0;  // rms distance of the heaviest fragment to its shape at rest, over the body's radius of gyration
};

/// Thresholds, in the order in which they are asked. docs/images/outcomes.png shows the regions that they separate.
// No piece holds a tenth of the mass: splinters and dust, no part among them.
inline constexpr double smash_largest = 0.1;
// A quarter of the mass has left the largest piece, or one other piece holds a twentieth: a part, not a splinter. A bar in three
// pieces of which the ends are short is in pieces, too.
inline constexpr double disunion_largest = 0.75;
inline constexpr double disunion_second = 0.05;
// Of the elements that a plane through the middle cuts. Not a share of all elements: the finer the lattice, the fewer of those a
// cut takes.
inline constexpr double crack_cut = 1.0 / 3;
// Most of the body has yielded, or it is out of shape by a tenth of its size.
inline constexpr double crush_yielded = 0.5;
inline constexpr double crush_shape = 0.1;

Outcome classify(const OutcomeMeasures& measures);

/// @param fragments  null for a body that cannot break
OutcomeMeasures measure_outcome(const BodyModel& moving, const Fragments* fragments,
                                const BodyCounts& counts);
inline OutcomeMeasures measure_outcome(const BodyModel& moving, const Fragments* fragments) {
  return measure_outcome(moving, fragments, moving.counts());
}

}  // namespace palpate::physics
