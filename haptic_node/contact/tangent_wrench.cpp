#include "haptic_node/contact/tangent_wrench.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "common/message/vec3.h"

namespace palpate::haptic {
namespace {

constexpr double lever =
    0.05;  // [m]: a turn counts as the way of a point this far off, a moment as its force there
constexpr double least_share =
    1e-3;  // of the largest eigenvalue: below it the spring does not hold that direction
constexpr double soft_share = 0.15;   // nor is any that it holds softer: a small force would store much there
constexpr double answer_rate = 80.0;  // most that an answer changes the force [N/s]
constexpr double outran_way = 0.05;   // from the answer's pose, beyond which it says nothing [m]
constexpr int most_tries = 18,
              slow_steps = 8;        // Why: the farthest part is known but for how the cone bends it
constexpr double negligible = 1e-9;  // [N]
constexpr double cone =
    0.5;  // m: how much of the stretch may lie beside the answer's, by the root of the energy

/// [m, m, m, rad, rad, rad] to metres throughout, and its inverse.
Vec6 in_metres(const Vec6& motion) noexcept {
  Vec6 m = motion;
  m.tail<3>() *= lever;
  return m;
}
Vec6 in_newtons(const Vec6& wrench) noexcept {
  Vec6 w = wrench;
  w.tail<3>() /= lever;
  return w;
}
Mat6 in_newtons_per_metre(const Mat6& K) noexcept {
  Mat6 k = 0.5 * (K + K.transpose());
  k.topRightCorner<3, 3>() /= lever;
  k.bottomLeftCorner<3, 3>() /= lever;
  k.bottomRightCorner<3, 3>() /= lever * lever;
  return k;
}

/// The positive part of a symmetric matrix, bounded in stiffness, and its pseudo-inverse.
struct Parts {
  Mat6 K = Mat6::Zero(), inverse = Mat6::Zero();
};
Parts positive_parts(const Mat6& K, double most) noexcept {
  Parts parts;
  const Eigen::SelfAdjointEigenSolver<Mat6> solver(K);
  if (solver.info() != Eigen::Success) return parts;
  const double largest = solver.eigenvalues()(5);
  if (!(largest > 0)) return parts;
  const double scale = std::min(1.0, most / largest);
  for (int i = 0; i < 6; ++i) {
    if (solver.eigenvalues()(i) <= least_share * largest) continue;
    const double value = std::max(solver.eigenvalues()(i), soft_share * largest);
    const Vec6 e = solver.eigenvectors().col(i);
    parts.K += scale * value * e * e.transpose();
    parts.inverse += 1 / (scale * value) * e * e.transpose();
  }
  return parts;
}

/// The largest p in [0, 1] for which p change, or moved + p change, is no longer than `most`.
/// @param change  of a wrench from now to its goal; @param moved  what the hand's way has just changed it by
double farthest_part(const Vec6& change, const Vec6& moved, double most) noexcept {
  const double squared = change.squaredNorm();
  if (!(squared > 0)) return 1;
  double part = most / std::sqrt(squared);
  const double half = change.dot(moved), root = half * half - squared * (moved.squaredNorm() - most * most);
  if (root >= 0) part = std::max(part, (std::sqrt(root) - half) / squared);
  return std::min(part, 1.0);
}

/// The projector on what a spring holds.
Mat6 range_of(const Mat6& K) noexcept {
  Mat6 range = Mat6::Zero();
  const Eigen::SelfAdjointEigenSolver<Mat6> solver(K);
  if (solver.info() != Eigen::Success) return range;
  for (int i = 0; i < 6; ++i)
    if (solver.eigenvalues()(i) > least_share * solver.eigenvalues()(5))
      range += solver.eigenvectors().col(i) * solver.eigenvectors().col(i).transpose();
  return range;
}

}  // namespace

void TangentWrench::take(const ToolWrench& wrench, double period) noexcept {
  x_0_ = vec(wrench.p_WT);
  q_0_ = Eigen::Quaterniond(wrench.q_WT[0], wrench.q_WT[1], wrench.q_WT[2], wrench.q_WT[3]).normalized();
  const Vec3 force = vec(wrench.force);
  Vec6 W;
  W << force, vec(wrench.moment) + (vec(wrench.set_point) - vec(wrench.tip)).cross(force);  // about the tip
  const Mat6 sent = Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(wrench.stiffness.data());
  Mat6 K = in_newtons_per_metre(sent);
  if (torque_limit_ <= 0) {
    K.rightCols<3>().setZero();
    K.bottomRows<3>().setZero();
    W.tail<3>().setZero();
  }
  knows_surface_ = wrench.normal != Array3{};
  if (knows_surface_)
    take_surface(K, vec(wrench.normal), wrench.stretch);
  else
    take_contact(K, in_newtons(W));
  has_ = true;
  remaining_ = period;
  // The stretch in directions that no spring holds is only the way that the hand went there.
  d_ = range_of(K_) * d_;
}

/// Only wrench and stiffness are known: the stretch is what makes the one of the other.
void TangentWrench::take_contact(const Mat6& K, const Vec6& W) noexcept {
  const Parts now = positive_parts(K, stiffness_);
  K_0_ = now.K;
  d_0_ = axis_0_ = now.inverse * W;
  W_0_ = K_0_ * d_0_;  // what no spring holds is not felt
}

/// The way a along the normal is held by a spring of rank one, K_1 = (K a) (K a)^T / (a . K a); the rest K - K_1 lets it free and is
/// limited first, so that a bed that hardly turns does not make the way soft. Where still too much is left, the whole
/// becomes softer and its compression longer: K d_0 stays, and so does the gap.
void TangentWrench::take_surface(const Mat6& K, const Vec3& normal, double stretch) noexcept {
  axis_0_ << normal, Vec3::Zero();
  K_0_.setZero();
  d_0_.setZero();
  W_0_.setZero();
  const Vec6 W_a = K * axis_0_;
  const double k = axis_0_.dot(W_a);
  if (!(k > 0)) return;  // no surface that could push
  const Mat6 along = W_a * W_a.transpose() / k;
  K_0_ = along + positive_parts(K - along, stiffness_).K;
  const double largest = Eigen::SelfAdjointEigenSolver<Mat6>(K_0_, Eigen::EigenvaluesOnly).eigenvalues()(5);
  const double softer = std::min(1.0, stiffness_ / largest);
  K_0_ *= softer;
  d_0_ = (stretch > 0 ? stretch / softer : stretch) * axis_0_;
  if (stretch <= 0) return;
  W_0_ = K_0_ * d_0_;
  const double torque = lever * W_0_.tail<3>().norm();
  if (torque <= torque_limit_) return;
  // K := T K T, T = 1 for ways and a shorter lever for turns: what the device cannot turn with costs no force.
  const double shorter = torque_limit_ / torque;
  K_0_.rightCols<3>() *= shorter;
  K_0_.bottomRows<3>() *= shorter;
  W_0_ = K_0_ * d_0_;
}

/// The stretch that a contact can have, by projection on a cone about that of the answer: with y = K^1/2 d, a along y_0 and b
/// beside it,   y_c = y where b <= m a,   0 where m b <= -a,   else t (y_0 / |y_0| + m b_0),  t = (a + m b) / (1 + m^2),
/// b_0 the unit vector beside y_0.
/// W = K d_c is the gradient of |y_c|^2 / 2, so holding back from pulling makes no energy.
Vec6 TangentWrench::pushing(const Vec6& d, const Mat6& K, const Vec6& axis) const noexcept {
  if (holds_) return d;
  const Vec6 W_e = K * axis;
  const double squared = axis.dot(W_e);
  if (!(squared > 0)) return Vec6::Zero();
  const double along = d.dot(W_e) / std::sqrt(squared);
  const double beside = std::sqrt(std::max(0.0, d.dot(K * d) - along * along));
  if (beside <= cone * along) return d;
  if (cone * beside <= -along) return Vec6::Zero();
  const double t = (along + cone * beside) / (1 + cone * cone);
  return t * ((1 - cone * along / beside) / std::sqrt(squared) * axis + cone / beside * d);
}

/// What is left of a wrench by the limits, 0..1. @param W  [N], the moment as a force
double TangentWrench::within_limits(const Vec6& W) const noexcept {
  const double force = W.head<3>().norm(), torque = lever * W.tail<3>().norm();
  double r = 1;
  if (force > limit_) r = limit_ / force;
  if (torque > torque_limit_) r = std::min(r, torque_limit_ / torque);
  return r;
}

/// S (2 r - r^2) of a spring that would store S and whose wrench ends at r.
double TangentWrench::energy(const Vec6& d, const Mat6& K, const Vec6& axis) const noexcept {
  const Vec6 d_c = pushing(d, K, axis), W = K * d_c;
  const double r = within_limits(W);
  return 0.5 * d_c.dot(W) * (2 * r - r * r);
}

/// A new contact begins with the answer's stiffness and no force: by what the surface has beyond the hand the spring is not
/// stretched yet.
void TangentWrench::begin(const Vec6& d_goal, bool far) noexcept {
  K_ = K_0_;
  axis_ = axis_0_;
  d_.setZero();
  if (!knows_surface_) return;
  if (far)
    K_.setZero();  // where it is now nobody knows
  else
    d_ = d_goal - pushing(d_goal, K_0_, axis_0_);
}

/// Against an answer that pushes the other way: a cone cannot turn from one side to the other without letting go.
/// @param goal, now  wrenches @return false: it does not
bool TangentWrench::give_way(const Vec6& goal, const Vec6& now, double dt, double share) noexcept {
  if (holds_ || knows_surface_ || !(goal.dot(now) < 0)) return false;
  const double before = energy(d_, K_, axis_), size = now.norm();
  d_ *= std::max(0.0, std::min(size, W_last_.norm()) - answer_rate * dt) / size;
  book(share * (energy(d_, K_, axis_) - before));
  return true;
}

/// Toward the answer's spring, as far as force and tank allow.
void TangentWrench::follow(const Vec6& d_goal, double dt, double share) noexcept {
  double part = remaining_ <= dt ? 1.0 : dt / remaining_;
  remaining_ = std::max(0.0, remaining_ - dt);
  const Vec6 W = K_ * pushing(d_, K_, axis_), felt = within_limits(W) * W;
  const Vec6 goal = K_0_ * pushing(d_goal, K_0_, axis_0_);
  if (give_way(goal, W, dt, share)) return;
  part = std::min(part, farthest_part(goal - W, W - W_last_, answer_rate * dt));
  const auto far_from = [&](const Vec6& w, const Vec6& was, const Vec6& limited) {
    return std::max((w - was).norm(), (within_limits(w) * w - limited).norm());
  };
  const double before = energy(d_, K_, axis_);
  for (int n = 0; n <= most_tries; ++n) {
    const Vec6 d = d_ + part * (d_goal - d_);
    const Mat6 K = K_ + part * (K_0_ - K_);
    const Vec6 axis = axis_ + part * (axis_0_ - axis_);
    const Vec6 W_next = K * pushing(d, K, axis);
    const double change = std::min(far_from(W_next, W, felt), far_from(W_next, W_last_, felt_last_));
    const double work = share * (energy(d, K, axis) - before);
    if (change <= answer_rate * dt && work <= tank_.level()) {
      d_ = d;
      K_ = K;
      axis_ = axis;
      book(work);
      return;
    }
    part *= n < slow_steps ? 0.8 : 0.5;
  }
}

/// The hand stretches the spring. One that fades, as there is nothing behind it, is not stretched any more: work against
/// it is lost, as against friction.
void TangentWrench::move(const Vec6& motion, double share) noexcept {
  const Vec6 d = d_ - motion;
  const bool left = has_ && !knows_surface_ && K_0_.isZero(0);
  const double before = energy(d_, K_, axis_), after = energy(d, K_, axis_);
  if (left && after > before) return;
  d_ = d;
  const double put_in = -felt_last_.dot(motion);
  never_put_in_ = std::min(share * after, never_put_in_ + std::max(0.0, share * (after - before - put_in)));
}

/// Work of an answer on the hand. What it takes of the spring and nobody had put in, nobody loses.
void TangentWrench::book(double work) noexcept {
  const double nobodys = std::clamp(-work, 0.0, never_put_in_);
  never_put_in_ -= nobodys;
  tank_.book(work + nobodys);
}

ContactResult TangentWrench::tick(const HandMotion& hand, double dt, double share) noexcept {
  ContactResult result;
  result.proxy = hand.x;
  W_last_ = K_ * pushing(d_, K_, axis_);
  felt_last_ = within_limits(W_last_) * W_last_;
  if (moved_once_) move(in_metres(motion_between(last_x_, last_q_, hand.x, hand.q)), share);
  moved_once_ = true;
  last_x_ = hand.x;
  last_q_ = hand.q;
  if (has_) {
    const Vec6 since = in_metres(motion_between(x_0_, q_0_, hand.x, hand.q));
    const bool touches = energy(d_, K_, axis_) > 0, far = since.norm() > outran_way;
    result.outran = far && (touches || W_0_.squaredNorm() > 0);
    Vec6 d_goal = d_0_ - since;
    if (!knows_surface_) d_goal = pushing(d_goal, K_0_, axis_0_);
    if (far) d_goal.setZero();
    if (!touches) begin(d_goal, far);
    if (touches || !far) follow(d_goal, dt, share);
  }
  Vec6 W = K_ * pushing(d_, K_, axis_);
  W *= within_limits(W);
  const Vec3 F = W.head<3>();
  const double size = F.norm();
  if (size > negligible) {
    const Vec3 n = F / size;
    const double damper = std::clamp(-damping_ * hand.v.dot(n), -size, 0.5 * size);
    result.force = F + damper * n;
    if (holds_) result.force *= std::min(1.0, limit_ / result.force.norm());
    result.torque = lever * W.tail<3>();
    result.stored = energy(d_, K_, axis_);
    result.n_planes = 1;
    result.depth = size / stiffness_;
    result.proxy = hand.x + result.force / stiffness_;
  } else if (!knows_surface_) {
    d_.setZero(), never_put_in_ = 0;  // has left the tissue
  }
  tank_.pass(dt, result.n_planes > 0);
  return result;
}

}  // namespace palpate::haptic
