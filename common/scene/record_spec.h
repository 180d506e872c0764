#pragma once
// [record] of a scene: what a run writes down.

namespace palpate {

struct RecordSpec {
  bool positions = false;  // positions of all masses
  bool forces = true;
  bool energy = true;  // where the energy is, over time
  double rate_Hz = 50;
};

}  // namespace palpate
