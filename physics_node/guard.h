#pragma once
// Watches that a scene's energy stays finite and within what was put in, and says when to go back.

#include <optional>

#include "physics_node/step/body_model.h"
#include "physics_node/step/energy_account.h"

namespace palpate::physics {

class Guard {
 public:
  enum class Verdict { sound, save, go_back };

  /// The books begin anew.
  void begin() noexcept;
  /// Looks at what the last watched step of a frame saw: a pass over rows, over all elements only where energy has
  /// grown, where much was put in, where something has come far in that step, and in the first frames. `save` is said
  /// every 50 frames.
  /// @param dt  of a step [s]
  Verdict look(const BodyModels& bodies, double dt, EnergyAccount& account, StepReport& report) noexcept;

  /// A tool's work was not finite, and what it moved is not either.
  void note_unusable_work() noexcept { unusable_work_ = true; }
  /// No growth since the last save: what was saved then is good.
  bool sound() const noexcept { return sound_; }
  void saved() noexcept { sound_ = true; }
  /// The state was thrown away. @return false: too often, the scene is given up
  bool may_try_again() noexcept;
  int recoveries() const noexcept { return recoveries_; }
  /// The body that cannot be stepped; frames then no longer move anything.
  std::optional<std::size_t> given_up() const noexcept { return given_up_; }
  void reset() noexcept;

 private:
  bool sound_ = true;
  int first_ = 0;           // frames still to come that are measured whatever they show
  double last_put_in_ = 0;  // [J], in the frame before
  bool unusable_work_ = false;
  int recoveries_ = 0;  // since the step was last chosen
  std::size_t culprit_ = 0;
  std::optional<std::size_t> given_up_;
};

}  // namespace palpate::physics
