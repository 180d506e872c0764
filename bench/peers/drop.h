#pragma once
// The drop: a cube of soft tissue, held at its bottom and at rest without weight, feels gravity from t = 0 on. It falls
// into itself, stretches and rings; nothing damps it.

#include "bench/peers/spring_body.h"
#include "common/scene/scene.h"

namespace palpate::bench {

struct Drop {
  Scene scene;             // for palpate; frames of 1 ms
  SpringBody body;         // the same for the peers
  double stable_step = 0;  // palpate's bound [s]
};

inline constexpr double frame_seconds = 1e-3;

/// A face-centred cube of about `masses` masses: E 10 kPa, 1000 kg/m^3, neighbours 5 mm apart, bottom layer held.
Drop make_drop(int masses);

}  // namespace palpate::bench
