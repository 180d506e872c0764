#pragma once
// How the wrench on a tool changes with the pose of the hand, learnt from what the tool collides with.
//
// Contacts of one frame with impulses J_i along n_i at arms r_i make the wrench and, as springs, a stiffness of that shape:
//
//   W_t = sum J_i g_i / T,   g_i = (n_i, r_i x n_i),     K_t = k S / (n.S n),   S = sum |J_i| g_i g_i^T,  n along the force
//
// k is what the force has answered to the hand's motion lately, by least squares over 0.2 s with a first guess. Impulses
// come in bursts, so both are low-passed twice, as an affine function of the pose: a filter that lags behind the force
// alone would lag behind the hand,
//
//   W := W - K xi,   then   W += a (W_t - W),  K += a (K_t - K)      xi the hand's motion in the frame
//
// so that on elastic tissue the wrench sent belongs to the pose sent with it. K_t itself is the tangent that is sent. Source:
// ours; the linear local model of slow tissue is Cavusoglu & Tendick 2000.

#include "physics_node/collision/contact_sum.h"
#include "physics_node/contact/low_pass.h"

namespace palpate::physics {

class TangentEstimate {
 public:
  /// @param low_pass_Hz  of both filters
  /// @param stiffness    first guess of k [N/m]; what is learnt stays within a tenth and ten times it
  TangentEstimate(double low_pass_Hz, double stiffness) noexcept
      : low_pass_Hz_(low_pass_Hz), first_(stiffness), k_(stiffness) {}
  void reset() noexcept { *this = TangentEstimate(low_pass_Hz_, first_); }

  /// Once a frame.
  /// @param sum     on the tool in this frame, about its tip
  /// @param motion  of the hand in the frame: way of the tip and turn [m], [rad]
  /// @param known   k where it is known otherwise; 0: it is learnt [N/m]
  void frame(const ContactSum& sum, const Vec6& motion, double seconds, double known = 0) noexcept;

  const Vec6& wrench() const noexcept { return twice_.W; }  // about the tip [N], [N m]
  const Mat6& stiffness() const noexcept { return K_; }
  double scale() const noexcept { return k_; }  // k [N/m]

 private:
  struct Affine {
    Vec6 W = Vec6::Zero();
    Mat6 K = Mat6::Zero();
    void move(const Vec6& motion, const Mat6& to_new_tip) noexcept;
    void approach(const Affine& other, double part) noexcept;
  };
  void learn(const Vec3& force, const Vec3& way, double part, double seconds) noexcept;

  double low_pass_Hz_, first_, k_;
  Affine once_, twice_;
  Mat6 spread_ = Mat6::Zero();
  Mat6 K_ = Mat6::Zero();            // K_t of the last frame
  double since_contact_ = 1e9;       // [s]
  TwiceLowPassed<Vec3> force_;       // as measured [N]
  Vec3 way_ = Vec3::Zero();          // of the tip since the start [m]
  TwiceLowPassed<Vec3> way_passed_;  // through the same filters
  double way_way_ = 0, way_force_ = 0;
};

}  // namespace palpate::physics
