#pragma once
// Physics that dies, or falls silent for a while, while the hand presses: what the hand feels of it, over many cases.

#include <string>
#include <vector>

#include "bench/haptic/trial.h"

namespace palpate::bench {

struct Silence {
  double latest = 0;       // from the last answer to 0 N [s]
  bool went_stale = true;  // in every case
  bool monotone = true;    // the force never rose while it faded
  double step = -1;        // largest change of force in a tick, beyond K (v T + q) [N]
  double found = 0;    // from the first frame of the new physics until the hand is ready, less the way [s]
  double surplus = 0;  // largest G [J]
};
/// In each case physics dies after 2 s of contact and is missed for 0.7 s. Then it is back, with the tool still inside.
Silence silence_in(const std::vector<Case>& cases);

/// F1: 0 N within 400 ms, steadily; ready within 0.1 s of the return; energy bound kept.
/// @param limit_step  of Silence::step [N]
bool fades(const Silence& silence, double limit_step) noexcept;
std::string text_of(const Silence& silence);

struct Return {
  double inside = 0;          // largest force between a long silence and leaving the tissue [N]
  double step = -1;           // as above [N]
  double excess = -1;         // of the work of planes above its bound [J]
  std::vector<double> again;  // force of each trial when it presses the next time [N]
};
/// In each case physics falls silent after 2 s of contact, for each of `away` [s]; the hand is out at 4 s and presses again from
/// 5 to 7 s. A silence of more than half a second counts as long.
Return return_in(const std::vector<Case>& cases, const std::vector<double>& away);

}  // namespace palpate::bench
