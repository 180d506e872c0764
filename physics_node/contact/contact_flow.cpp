#include "physics_node/contact/contact_flow.h"

namespace palpate::physics {
namespace {

// Why: far below the millisecond of a hand, and long enough that g does not drown what a branch bears.
constexpr double short_time = 0.3e-3;  // [s]
// Why: less than a degree at 20 Hz.
constexpr double shortest_lag = 0.1e-3;  // [s]

// What a damper takes of all relative motion of its ends over what it takes of that along it, of springs in all
// directions and a bar that is drawn: <|e n|^2> / <(n . e n)^2>, e = diag(-nu, -nu, 1), nu = 1/3.
constexpr double relative_over_axial = 2.4;

/// Viscosity over modulus [s].
double lag_of(const Body& body) noexcept {
  if (body.solid || body.mesh) return damper_time(body);
  const ElementLaw& law = body.law;
  if (law.damper == Damper::drag) return 0;
  double c = 0, k = 0;
  for (std::size_t d = 0; d < law.k1.size(); ++d) c += law.c[d], k += law.k1[d];
  return k > 0 ? (law.damper == Damper::relative ? relative_over_axial : 1.0) * c / k : 0;
}

}  // namespace

void ContactFlow::add(double share, double time, bool viscous) noexcept {
  if (n_ < branches_.size()) branches_[n_++] = {share, time, 0, viscous};
}

void ContactFlow::begin(const Body& body) noexcept {
  n_ = 0;
  lasting_ = 1;
  dt_ = 0;
  if (body.solid)
    for (const Relaxation& term : body.solid->relaxation) lasting_ -= term.share;
  if (const double lag = lag_of(body) / lasting_; lag >= shortest_lag)
    add(lag / short_time, short_time, true);
  if (body.solid)
    for (const Relaxation& term : body.solid->relaxation) add(term.share / lasting_, term.time, false);
  rest();
}

void ContactFlow::rest() noexcept {
  staying_ = 0;
  for (Branch& branch : branches_) branch.force = 0;
}

void ContactFlow::set_step(double dt) noexcept {
  dt_ = dt;
  stiffness_ = 1;
  for (std::size_t j = 0; j < n_; ++j) {
    steps_[j] = LagStep::over(dt, branches_[j].time);
    stiffness_ += branches_[j].share * steps_[j].mean;
  }
}

void ContactFlow::pass(double F, double dt) noexcept {
  if (!(dt > 0)) return;
  if (dt != dt_) set_step(dt);
  double lag = 0;
  for (std::size_t j = 0; j < n_; ++j) {
    branches_[j].force = steps_[j].begun(branches_[j].force, staying_);
    lag += branches_[j].share * branches_[j].force;
  }
  staying_ = (F + lag) / stiffness_;
  for (std::size_t j = 0; j < n_; ++j) branches_[j].force += steps_[j].last() * staying_;
}

}  // namespace palpate::physics
