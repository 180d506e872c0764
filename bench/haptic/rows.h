#pragma once
// The acceptance rows of the haptic loop. Each runs its experiments, says its figure and whether it is within the limit.
// docs/haptics.md has a table of them.

#include <string>
#include <vector>

#include "bench/haptic/matrix.h"
#include "bench/haptic/touch_trials.h"

namespace palpate::bench {

struct Row {
  std::string id;      // "S2"
  std::string what;    // was done
  std::string limit;   // that it must keep
  std::string figure;  // that came out
  bool pass = false;
};

struct Runs {
  Effort effort = Effort::full;
  int jobs = 1;
  std::vector<CaseResult> seen;    // all cases with the production controller so far, for S6
  std::vector<CaseResult> raw;     // with raw planes
  std::vector<CaseResult> world;   // with real tissue
  std::vector<CaseResult> copied;  // with a copy of tissue
  std::vector<SineFelt> sines;     // of T1
};

// rows_matrix.cpp
Row direct_and_raw_are_unstable(Runs& runs);        // S0
Row wall_is_stable(Runs& runs);                     // S1
Row stiffest_wall(Runs& runs);                      // S1
Row matrix_is_stable(Runs& runs);                   // S2
Row push_without_a_hand_gains_nothing(Runs& runs);  // S2
Row stiff_matrix_is_stable(Runs& runs);             // S3
Row unruly_links_are_borne(Runs& runs);             // N1
Row gaps_are_borne(Runs& runs);                     // N1
Row clocks_may_differ(const Runs& runs);            // N1

// rows_force.cpp
Row force_is_true(Runs& runs);                // S4
Row pulse_is_felt(Runs& runs);                // S5
Row force_steps_are_small(const Runs& runs);  // S6
Row free_space_is_free(double loss = 0.01);   // S10; loss: of patches, 1 for a hand that is never armed
Row saturation_is_quiet();                    // S11
Row world_pulse_is_felt(Runs& runs);          // S5
Row world_free_space_is_free();               // S10
Row world_saturation_is_quiet();              // S11

// rows_events.cpp
Row teleports_push_gently();    // S7
Row silence_fades();            // F1
Row return_is_no_kick();        // F2
Row bad_devices_are_stopped();  // F5

// rows_contact.cpp
Row edges_and_corners();  // S8
Row sphere_is_round();    // S8

// rows_world.cpp: with the real physics library as the object
Row world_is_stable(Runs& runs);               // S2, S6
Row world_force_is_true(Runs& runs);           // S4
Row world_tissue_is_stable(Runs& runs);        // S2
Row world_tissue_is_true(Runs& runs);          // T1
Row world_tissue_slides(Runs& runs);           // T11
Row world_tissue_bears_a_stick(Runs& runs);    // T14
Row world_silence_fades();                     // F1
Row world_return_is_no_kick();                 // F2
Row world_raw_is_unstable(Runs& runs);         // S0
Row stick_is_steady(Runs& runs);               // S12
Row stick_with_torques_is_steady(Runs& runs);  // S12

// rows_world_links.cpp
Row world_wall_is_stable(Runs& runs);           // S1
Row world_bears_a_stiff_spring(Runs& runs);     // S3
Row world_bears_unruly_links(Runs& runs);       // N1
Row world_teleports_push_gently();              // S7
Row world_edge_has_no_ghost(const Runs& runs);  // S8

// rows_torque.cpp
Row torque_is_bounded(const Runs& runs);  // S12

// rows_closed_form.cpp; and the list of all rows
Row proxy_is_exact(const Runs& runs);        // S9
Row calibration_is_exact(const Runs& runs);  // S13
Row rubbish_is_harmless(const Runs& runs);   // F3

/// All of them, in order.
std::vector<Row> all_rows(Runs& runs);

}  // namespace palpate::bench
