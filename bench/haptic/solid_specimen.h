#pragma once
// The product's own tissue as a specimen: a block of finite elements, pressed along its normal on a round patch of its upper side, in its
// own explicit steps and with all that is nonlinear in them.

#include <memory>
#include <vector>

#include "haptic_node/tissue/tissue_model.h"
#include "physics_node/reduced/driving_point.h"
#include "physics_node/step/body_model.h"

namespace palpate::bench {

class SolidSpecimen {
 public:
  static constexpr double step = 5e-5;  // [s]

  /// @param modes  told of those that the contact feels most, up to nine
  explicit SolidSpecimen(int modes);

  /// One step. @param force  on the patch, downwards [N]
  void advance(double force);
  double surface() const noexcept { return depth_; }  // of the patch, mean by its shares, downwards [m]
  double speed() const noexcept { return speed_; }    // [m/s]
  /// Modes, the compliance of what is not told, and the body's own state in them: r is not smoothed.
  void tell(double force, haptic::TissueAnswer& answer) const;

 private:
  struct Told {
    haptic::TissueMode mode;
    std::vector<double> moment;  // m phi of each component, by node of the body  (3 n_nodes) [kg^1/2]
  };
  void choose(const physics::DrivingPoint& point, const physics::VibrationModes& modes,
              const physics::LinearAnswer& answer, int count);
  void measure() noexcept;

  std::unique_ptr<physics::BodyModel> model_;
  std::vector<physics::MassShare> patch_;
  std::vector<physics::NodalForce> push_;
  std::vector<Told> told_;
  double residual_ = 0;  // [m/N]
  double depth_ = 0, speed_ = 0;
};

}  // namespace palpate::bench
