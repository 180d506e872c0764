#pragma once
// The masses of a tool by which a hand holds it, led along the hand's path.

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "common/math/six.h"
#include "physics_node/step/node_motion.h"

namespace palpate::physics {

struct Pose {
  Vec3 p = Vec3::Zero();                                  // of the tip [m]
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();  // turned from how the body rests
};

/// From one pose to another: way [m] and turn as axis times angle [rad].
Vec6 motion(const Pose& from, const Pose& to) noexcept;

/// Work that the hand did, and the impulse that it gave.
struct HandleWork {
  double work = 0;              // [J]
  Vec3 linear = Vec3::Zero();   // [N s]
  Vec3 angular = Vec3::Zero();  // about the origin [N m s]
};

class Handle {
 public:
  explicit Handle(const Body& body);

  /// After the elements have moved everything by dt: puts each mass of the handle where the pose wants it, by the velocity
  /// that leads there from where it was at the beginning of the step,
  ///   v := (p + R (X - X_tip) - x_0) / dt,   x := x_0 + dt v.
  /// The hand's work is that of the impulse m (v - v_1), v_1 as the elements left it: m (v - v_1) . (v_0 + v) / 2, with v_0 from
  /// note() before the step; where nobody noted it, as with backward_euler, which has impulses act at its end, with v_1.
  HandleWork lead(NodeMotion& moving, const Pose& pose, double dt) noexcept;
  /// Remembers how fast its masses move.
  void note(const NodeMotion& moving) noexcept;
  void reset() noexcept { noted_ = false; }

  std::size_t size() const { return cell_.size(); }

 private:
  Vec3 tip_;
  std::vector<Index> cell_;
  std::vector<std::uint32_t> all_;  // 0, 1, 2 ...
  std::vector<Vec3> rest_, x_, v_, v_move_, v_0_;
  std::vector<double> mass_;
  std::vector<NodalPush> pushes_;
  bool noted_ = false;
};

}  // namespace palpate::physics
