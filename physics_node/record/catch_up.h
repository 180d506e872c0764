#pragma once
// A session that goes on where a recorded one was, half cut or not: the record is run again to there, which leaves the same bits.

#include <cstdint>
#include <functional>
#include <string>

#include "physics_node/record/recorder.h"
#include "physics_node/world.h"

namespace palpate::physics {

struct CaughtUp {
  double t = 0;                // where the world is now [s]
  std::uint64_t compared = 0;  // states that were found as recorded
};

/// The newest moment that a record can be run again to [s].
/// @throws InputError: no record of a session, damaged, or shorter than `at`
double time_in_record(const std::string& record, double at, double frame_seconds);

/// Runs the record again until `at` and then a frame without hands: whoever comes now is another hand.
/// @param at  simulated time [s]; infinite: to the end of the record
/// @param world  just made
/// @param recorder  of the session that goes on: it gets everything, so that its own record begins where the first did; may be null
/// @param goes_on  asked at each frame; false: a person does not want to wait
/// @throws InputError as above, or where states differ: another scene or another version
CaughtUp catch_up(const std::string& record, double at, World& world, Recorder* recorder,
                  const std::function<bool()>& goes_on);

}  // namespace palpate::physics
