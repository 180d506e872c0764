#pragma once
// What a tool that is more than a point feels between two answers of physics: stick, knife, needle, any body.
//
// Physics says which wrench W_0 it found at which pose of the hand and how it changes there, K = -dW/dX (6 x 6). That is
// a spring of six dimensions, stretched by d, which the hand compresses as it moves by xi:
//
//   W = K d,     d := d - xi each tick,     d -> d_0 - (motion since W_0's pose) at each answer,    d_0 = K^+ W_0
//
// Where physics knows the surface beside the tool it tells instead how far that spring is stretched along the normal,
// d_0 = (s n, 0). Before contact s is below 0, the gap that is left: the spring stands ready, and what compresses
// it is the hand's own motion, for which no tank has to pay. A moment beyond what the device can turn with is felt as if
// the tissue pressed nearer to the hand, so that the force stays.
// What physics finds nothing at any more fades, and does not press harder however the hand moves.
// It only pushes: the stretch stays within a cone about the answer's, of 27 degrees by energy; where the answer
// pushes the other way it first gives way to nothing. But a tool that holds tissue pulls as well, and by no more than
// its grip. An answer moves stretch and stiffness over about a period, no faster than 80 N/s but for what the hand's
// own way has just changed: else a fast hand would press a spring that tissue has long yielded to. Work that this
// does on the hand is paid from the tank: tissue that answers late cannot feed the hand.
// Source: Astley & Hayward 1998 and Cavusoglu & Tendick 2000 (linear models of slow tissue); the six-dimensional form, the
// cone and the tank are ours.

#include <algorithm>
#include <limits>

#include "common/message/messages.h"
#include "haptic_node/contact/contact_result.h"
#include "haptic_node/contact/hand_motion.h"
#include "haptic_node/contact/work_tank.h"

namespace palpate::haptic {

class TangentWrench {
 public:
  /// @param stiffness  most that the spring may have in any direction [N/m], turns by what they do 5 cm off; the wrench at the
  ///                   answer's pose stays what it is
  /// @param damping    along the force [N s/m]
  /// @param limit, torque_limit  beyond which the spring does not push or turn harder: both are shortened together [N],
  ///                   [N m]. Torque limit 0: the device gives none, and turns neither make nor store anything.
  /// @param grip       of a tool that holds what it touches [N]; 0: it only pushes
  TangentWrench(double stiffness, double damping, double limit = std::numeric_limits<double>::infinity(),
                double torque_limit = std::numeric_limits<double>::infinity(), double grip = 0) noexcept
      : stiffness_(stiffness),
        damping_(damping),
        limit_(grip > 0 ? std::min(limit, grip) : limit),
        torque_limit_(torque_limit),
        holds_(grip > 0) {}

  /// A new answer, reached after about `period` seconds. It must have passed WrenchWatch. Costs three 6 x 6 eigenproblems at most.
  void take(const ToolWrench& wrench, double period) noexcept;

  /// True if the newest answer says that the tissue pushes.
  bool penetrated() const noexcept { return has_ && W_0_.head<3>().norm() > touch_N; }

  /// Contract: real time.
  /// @param share  of this force that reached the hand in the last tick, 0..1: work is done by no more than that
  ContactResult tick(const HandMotion& hand, double dt, double share = 1) noexcept;

  /// The stretch becomes `keep` (0..1) of what it is.
  void weaken(double keep) noexcept { d_ *= keep, never_put_in_ = 0; }
  /// Forgets the spring: the next contact begins at zero force.
  void release() noexcept { d_.setZero(), K_.setZero(), never_put_in_ = 0; }

  /// @return what the tank allows of `work` [J], booked
  double pay(double work) noexcept { return tank_.pay(work); }

  /// Work of moving springs on the hand since the start [J].
  double work() const noexcept { return tank_.booked(); }

 private:
  static constexpr double touch_N = 0.01;

  void take_contact(const Mat6& K, const Vec6& W) noexcept;
  void take_surface(const Mat6& K, const Vec3& normal, double stretch) noexcept;
  void begin(const Vec6& d_goal, bool far) noexcept;
  void follow(const Vec6& d_goal, double dt, double share) noexcept;
  bool give_way(const Vec6& goal, const Vec6& now, double dt, double share) noexcept;
  Vec6 pushing(const Vec6& d, const Mat6& K, const Vec6& axis) const noexcept;
  double energy(const Vec6& d, const Mat6& K, const Vec6& axis) const noexcept;

  void move(const Vec6& motion, double share) noexcept;
  void book(double work) noexcept;
  double within_limits(const Vec6& W) const noexcept;

  double stiffness_, damping_, limit_, torque_limit_;
  bool holds_;  // pulls as well as it pushes
  // the newest answer
  bool has_ = false;
  bool knows_surface_ = false;
  Vec3 x_0_ = Vec3::Zero();
  Eigen::Quaterniond q_0_ = Eigen::Quaterniond::Identity();
  Vec6 W_0_ = Vec6::Zero(), d_0_ = Vec6::Zero();
  Vec6 axis_0_ = Vec6::Zero();
  Mat6 K_0_ = Mat6::Zero();
  double remaining_ = 0;  // until it is reached [s]
  // the spring that is felt
  Vec6 d_ = Vec6::Zero();
  Vec6 axis_ = Vec6::Zero();  // of the cone: the answer's, followed
  Mat6 K_ = Mat6::Zero();
  Vec6 W_last_ = Vec6::Zero(), felt_last_ = Vec6::Zero();  // before the hand moved in this tick
  bool moved_once_ = false;
  /// Of what the spring stores: a force that stands for a tick takes less from the hand than one that grows on the
  /// way [J].
  double never_put_in_ = 0;
  Vec3 last_x_ = Vec3::Zero();
  Eigen::Quaterniond last_q_ = Eigen::Quaterniond::Identity();
  WorkTank tank_;
};

}  // namespace palpate::haptic
