#pragma once
// A body of the product, stepped alone, some of whose nodes are led: as a testing machine would.

#include <functional>
#include <memory>
#include <vector>

#include "physics_node/step/body_model.h"

namespace palpate::bench {

class DrivenBody {
 public:
  DrivenBody(physics::Body body, Precision precision);

  /// Components of nodes that are led from now on, by a mask (1: x, 2: y, 4: z), chosen by their rest positions.
  void drive(const std::function<unsigned(const Vec3&)>& axes_of);
  /// How a led node is displaced, by its rest position and time since the call of run() [m].
  using Way = std::function<Vec3(const Vec3& rest, double t)>;

  double share = 0.6;  // of the stable step that a step takes
  /// After each step, with its length: contact and the like.
  std::function<void(double dt)> after_step;

  void run(double seconds, const Way& way);
  /// With led nodes where they are, until it is at rest: all stop whenever kinetic energy has passed a peak.
  /// @param enough  a peak, in the largest elastic energy so far. @return did it come to rest?
  bool settle(double enough = 1e-10, int most_steps = 20000);

  physics::BodyModel& model() { return *model_; }
  const physics::BodyModel& model() const { return *model_; }
  /// On the led nodes that it picks, by what led them, in the last step [N].
  Vec3 force(const std::function<bool(const Vec3&)>& picks) const;
  /// Moment of the same about a point of space [N m].
  Vec3 moment(const Vec3& about, const std::function<bool(const Vec3&)>& picks) const;
  double least_corner_J() const { return *model_->counts().least_corner_J; }  // of all steps
  std::int64_t steps() const { return steps_; }

 private:
  struct Led {
    physics::Index node = 0;
    unsigned axes = 0;
    Vec3 u = Vec3::Zero(), v = Vec3::Zero();  // as it was put last; components that are led count
    Vec3 force = Vec3::Zero();
  };
  void step(const std::function<Vec3(const Vec3& rest)>& target, double dt);
  double next_dt(double part) const;
  double kinetic() const;
  void stop();

  std::unique_ptr<physics::BodyModel> model_;
  double stable_step_;
  double stiffening_ = 1, most_elastic_ = 0;
  std::vector<Led> led_;
  std::int64_t steps_ = 0;
};

}  // namespace palpate::bench
