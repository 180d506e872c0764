#pragma once
// Does the copy foretell what tissue does? The force that the shadow has at a sample is kept until the answer of that
// sample comes, an age of the answers later, and the two are compared:
//
//   off(s) = |F*(s) - F(s)| > max(1/4 max(|F*|, |F|), 5/4 |F(s_0) - F(s)|),   B := B + (1 - e^(-dt / T)) (off - B)
//
// F(s_0) the force of the answer that it was foretold from: who cannot know that tissue moves by itself (a pulse) is no
// worse than one who foretells nothing, and is not doubted.
//
// the share of answers of late, over T, that it was off. From B > 1/2 on it is doubted, and for 2 s after: model_fade.h
// then is slow.
// An event, a cut or a yield, is foretold wrongly for one age alone, and is none.
// Source: ours.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "common/math/vec3.h"
#include "haptic_node/tissue/motion_history.h"

namespace palpate::haptic {

class ModelTrust {
 public:
  explicit ModelTrust(double h) noexcept : h_(h) {}

  /// What the shadow bears at a sample, when that is the newest, and bore at its last answer [N].
  void foretell(std::uint64_t sample, const Vec3& force, const Vec3& from) noexcept {
    foretold_[sample % foretold_.size()] = {sample, force, from};
  }
  /// What tissue bore at one that has been foretold, or not.
  void compare(std::uint64_t sample, std::uint64_t newest, const Vec3& force) noexcept {
    const Foretold& then = foretold_[sample % foretold_.size()];
    if (then.sample != sample || sample <= compared_) return;
    const double size = std::max(force.norm(), then.force.norm());
    if (size < least_force) return;
    const double since = std::min(h_ * static_cast<double>(sample - compared_), longest);
    compared_ = sample;
    const double allowed = std::max(off_share * size, over_nothing * (force - then.from).norm());
    const double off = (force - then.force).norm() > allowed ? 1.0 : 0.0;
    bad_ -= std::expm1(-since / window) * (off - bad_);
    if (bad_ > 0.5) doubted_until_ = newest + static_cast<std::uint64_t>(std::lround(doubt / h_));
  }
  bool doubted(std::uint64_t newest) const noexcept { return newest < doubted_until_; }

 private:
  static constexpr double off_share = 0.25, over_nothing = 1.25;
  static constexpr double least_force = 0.05;  // Why: less is no swing that a hand would feel [N]
  static constexpr double window =
      0.4;  // T. Why: answers of 20 Hz and 100 ms are off for 150 ms after a cut [s]
  static constexpr double longest = 0.1;  // that one answer stands for [s]
  static constexpr double doubt = 2;      // [s]

  struct Foretold {
    std::uint64_t sample = 0;
    Vec3 force = Vec3::Zero(), from = Vec3::Zero();
  };
  double h_;
  std::array<Foretold, TipHistory::kept> foretold_{};
  double bad_ = 0;  // B
  std::uint64_t compared_ = 0, doubted_until_ = 0;
};

}  // namespace palpate::haptic
