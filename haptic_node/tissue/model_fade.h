#pragma once
// What is felt, on its way to what physics knows. The felt copy S goes a share beta of the way to the shadow S* in each tick:
//
//   S := S + beta (S* - S),   in the surface, q, w, p, and in the parameters, the normal among them
//   beta = the largest in [0, alpha], alpha = 1 - exp(-h / tau), for which H rises by no more than the tank holds, and
//          F changes by no more than a given step
//
// tau is 5 times the age of the answers, 5 to 50 ms, so that a wrong model stands still: what it does comes back after that
// age. A model that is doubted (model_trust.h) comes in 150 ms, whatever happens. After an event, which takes force and
// energy away (a cut, a yield), it is 10 ms: from where S* lies below F by 0.1 N and a quarter, until it has been
// reached. A ripple is no event: within 0.5 s after S* was above F it does not count.
// A tip in the air pays as well. A copy that is too soft and heavy runs away from the hand, and what it was given on its way
// for nothing the hand met when it came back: up to 1.6 mJ each time, and a bouncing handle gained 0.5 J.
// Source: Hannaford & Ryu 2002 for what pays; the fade is ours.

#include "haptic_node/contact/work_tank.h"
#include "haptic_node/tissue/tissue_step.h"

namespace palpate::haptic {

/// A model with its state, and what steps it.
struct TissueCopy {
  TissueStep step;
  TissueState state;
};

/// S + beta (S* - S); both have the same counts.
TissueCopy mixed(const TissueCopy& felt, const TissueCopy& shadow, double beta) noexcept;

class ModelFade {
 public:
  static constexpr double slow = 50e-3, least = 5e-3;  // tau, at most and at least [s]
  static constexpr double quick = 10e-3;               // after an event [s]
  static constexpr double doubtful = 150e-3;           // of a model that is doubted [s]
  static constexpr double over_age = 5;                // tau over the age of answers
  static constexpr double event_force = 0.1;           // that S* lies below F [N]
  static constexpr double event_share = 0.25;          // of F
  static constexpr double event_over = 0.02;           // that is left of it in the end [N]
  static constexpr double ripple_force = 0.05;         // that S* lies above F [N]
  static constexpr double ripple_rest = 0.5;           // after which it counts no more [s]

  /// One tick: moves `felt` towards `shadow`, both with the tip at x.
  /// @param force_step  most change of F [N]  @param age  of the oldest answers of late [s]
  /// @param doubted  what the shadow does is not what tissue does
  /// @return energy that it put into the felt copy, taken from the tank [J]
  double pass(TissueCopy& felt, const TissueCopy& shadow, const Vec3& x, double force_step, WorkTank& tank,
              double age, bool doubted = false) noexcept;

  bool falling() const noexcept { return falling_; }

 private:
  bool is_event(double felt, double shadow, double h) noexcept;

  bool falling_ = false;
  double quiet_for_ = ripple_rest;  // since S* was above F [s]
};

}  // namespace palpate::haptic
