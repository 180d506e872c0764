#pragma once
// The physics side of a true touch: tissue pressed by the hand's recorded motion, in the hand's own time, through the spring and
// damper that the hand feels. Between two samples the hand goes straight; the tissue's steps are 20 us, of elements 50 us.
// A message brings the last 128 samples, so that lost ones lose nothing. When none has come for 50 ms, the tissue goes on under a
// hand that stands still, whose spring fades in 200 ms; it comes back as fast.

#include <functional>
#include <memory>
#include <vector>

#include "bench/haptic/specimen.h"
#include "bench/haptic/told_samples.h"
#include "haptic_node/tissue/contact_spring.h"

namespace palpate::bench {

class PressedTissue {
 public:
  static constexpr double sample_time = 1e-3;           // [s]
  static constexpr double silence = 50e-3, fade = 0.2;  // [s]

  PressedTissue(const SpecimenModel& model, const ModelError& error, const haptic::ContactSpring& spring)
      : specimen_(model, error), spring_(spring) {}

  /// A frame. @param hand  newest message, or null  @param since  the frame before [s]
  /// @param each  before each step with the number of the sample, and parts of it, that the tissue has come to
  void frame(const HandSamples* hand, double since, const std::function<void(double)>& each = {});

  haptic::TissueAnswer answer(std::uint64_t tick);
  Specimen& specimen() noexcept { return specimen_; }

  std::uint64_t stamp() const noexcept { return stamp_; }
  /// Force that the tissue bore at a sample [N]; 0 before the first. Only up to stamp().
  double borne(std::uint64_t sample) const { return sample < borne_.size() ? borne_[sample] : 0.0; }

 private:
  void play(const HandSample& a, const HandSample& b, double time, const std::function<void(double)>& each);
  double press(double x, double v) const noexcept;

  Specimen specimen_;
  haptic::ContactSpring spring_;
  std::uint64_t stamp_ = 0;
  HandSample last_;
  double force_ = 0, gain_ = 1, silent_for_ = 0;
  std::vector<double> borne_;  // by sample
};

}  // namespace palpate::bench
