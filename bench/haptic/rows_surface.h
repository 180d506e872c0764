#pragma once
// The rows of the coupling that feels a copy of a surface: pressing, sliding and friction in space.

#include "bench/haptic/rows.h"
#include "bench/haptic/surface_trial.h"

namespace palpate::bench {

Row surface_taps_are_felt_as_borne(Runs& runs);     // T10
Row slides_are_felt_as_borne(Runs& runs);           // T11
Row frozen_surface_is_seen_through(Runs& runs);     // T11, negative control
Row modes_alone_are_seen_through(Runs& runs);       // T11, negative control
Row hold_after_a_slide_is_still(Runs& runs);        // T12
Row surface_gives_nothing_to_a_handle(Runs& runs);  // T13

}  // namespace palpate::bench
