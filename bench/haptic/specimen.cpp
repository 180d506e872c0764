#include "bench/haptic/specimen.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace palpate::bench {
namespace {

constexpr double rest_smoothing = 5e-3;  // of what the modes do not tell [s]
constexpr double hertz_shift = 1e-4;     // [m]: the ball is flat by so much, and not infinitely soft at first
// Why: a model that is too soft at first touch is felt as such for as long as the fade takes; one that is too stiff, less.
constexpr double least_told_depth = 1e-3;  // [m]

}  // namespace

const SpecimenModel chain_of_ten{"chain", 10, 0.01, 2.0, 2000.0, 0.1};
const SpecimenModel relaxing_solid{"SLS", 1, 0.1, 2.0, 200.0, 0, false, 0, 200.0, 0.1};
const SpecimenModel slow_solid{"slow SLS", 1, 0.1, 2.0, 200.0, 0, false, 0, 200.0, 1.0};
const SpecimenModel hertz_ball{"Hertz", 1, 0.019, 1.0, 4472.0, 0, true};
const SpecimenModel solid_block{.name = "block of elements", .solid = true};
const SpecimenModel yielding_lump{"yield", 1, 0.1, 2.0, 200.0, 0, false, 0.5};

SpecimenModel specimen_of(const ObjectModel& object) noexcept {
  return {object.name, object.mass > 0 ? 1 : 0, object.mass, object.damping, object.stiffness};
}

Specimen::Specimen(const SpecimenModel& model, const ModelError& error) : model_(model), error_(error) {
  u_.assign(static_cast<std::size_t>(model.masses), 0.0);
  v_ = u_;
  if (model.solid) solid_ = std::make_unique<SolidSpecimen>(error.modes);
  if (model.masses > 1) find_modes();
}

/// Of K u = omega^2 m u, the lowest.
void Specimen::find_modes() {
  const int n = model_.masses, told = std::min(n, error_.modes);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    K(i, i) += model_.stiffness;
    if (i + 1 < n) K(i + 1, i + 1) += model_.stiffness, K(i, i + 1) = K(i + 1, i) = -model_.stiffness;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved(K / model_.mass);
  double compliance = n / model_.stiffness;
  modes_.n_modes = static_cast<std::uint32_t>(told);
  for (int i = 0; i < told; ++i) {
    Eigen::VectorXd shape = solved.eigenvectors().col(i) / std::sqrt(model_.mass);
    if (shape(0) < 0) shape = -shape;
    const double squared = solved.eigenvalues()(i);  // omega^2; links damp in proportion to their stiffness
    modes_.modes[static_cast<std::size_t>(i)] = {
        Vec3(0, 0, -shape(0)), squared,
        model_.drag / model_.mass + squared * model_.damping / model_.stiffness};
    compliance -= shape(0) * shape(0) / squared;
    shapes_.emplace_back(shape.data(), shape.data() + n);
  }
  modes_.residual = std::max(0.0, compliance);
}

/// Of link i, below mass i, pressed [N].
double Specimen::link_force(std::size_t i) noexcept {
  const bool last = i + 1 == u_.size();
  const double d = u_[i] - (last ? base_ + plastic_ : u_[i + 1]);
  const double d_dot = v_[i] - (last ? 0.0 : v_[i + 1]);
  if (model_.hertz)
    return kept_ * model_.stiffness *
               (d > 0 ? std::pow(d + hertz_shift, 1.5) - std::pow(hertz_shift, 1.5)
                      : 1.5 * std::sqrt(hertz_shift) * d) +
           model_.damping * d_dot;
  double elastic = kept_ * model_.stiffness * d;
  if (model_.yield_force > 0 && elastic > model_.yield_force) {
    plastic_ += (elastic - model_.yield_force) / (kept_ * model_.stiffness);
    elastic = model_.yield_force;
  }
  return elastic + model_.damping * d_dot;
}

void Specimen::advance(double force, double dt) {
  pressed_for_ = force > 0 ? pressed_for_ + dt : 0.0;
  since_told_ += dt;
  if (solid_) return solid_->advance(force);
  if (u_.empty()) return;
  double above = force - model_.branch_stiffness * (u_[0] - branch_);
  for (std::size_t i = 0; i < u_.size(); ++i) {
    const double below = link_force(i);
    const double acceleration = (above - below - model_.drag * v_[i]) / model_.mass;
    if (i == 0) acceleration_ = acceleration;
    above = below;
    v_[i] += dt * acceleration;
  }
  for (std::size_t i = 0; i < u_.size(); ++i) u_[i] += dt * v_[i];
  if (model_.branch_stiffness > 0) branch_ += dt / model_.branch_time * (u_[0] - branch_);
}

double Specimen::tangent() const noexcept {
  if (!model_.hertz) return kept_ * model_.stiffness;
  return kept_ * 1.5 * model_.stiffness * std::sqrt(std::max(least_told_depth, u_[0] - base_) + hertz_shift);
}

/// From the factor to 1, in proportion to the time in contact.
double Specimen::told_stiffness_factor() const noexcept {
  if (error_.learnt_in <= 0) return error_.stiffness;
  return std::pow(error_.stiffness, 1 - std::min(1.0, pressed_for_ / error_.learnt_in));
}

/// Low-passed from one answer to the next.
double Specimen::smooth_rest(double rest) noexcept {
  rest_ = rest_known_ ? rest_ - std::expm1(-since_told_ / rest_smoothing) * (rest - rest_) : rest;
  rest_known_ = true;
  since_told_ = 0;
  return rest_;
}

/// k the tangent, of a ball at 1 mm at least; the rest is where k would have to begin for the force that now accelerates the told mass.
void Specimen::tell_lump(double force, haptic::TissueAnswer& answer) {
  const double m = error_.mass * model_.mass, c = error_.damping * (model_.damping + model_.drag);
  const bool relaxes = model_.branch_stiffness > 0, tells = relaxes && error_.tells_branches;
  // A branch that is not told is stiffness for what is fast; its relaxation then is in the rest.
  const double k =
      told_stiffness_factor() * (tangent() + (relaxes && !tells ? model_.branch_stiffness : 0.0));
  const double z = u_[0];
  answer.model.n_modes = 1;
  answer.model.modes[0] = {Vec3(0, 0, -1 / std::sqrt(m)), k / m, c / m};
  double elastic = force - m * acceleration_ - c * v_[0];
  if (tells) {
    answer.model.n_branches = 1;
    answer.model.branches[0] = {model_.branch_stiffness, model_.branch_time};
    elastic -= model_.branch_stiffness * (z - branch_);
  }
  const double rest = smooth_rest(z - elastic / k);
  answer.state.rest.z() = -rest;
  if (tells) answer.state.p[0] = branch_ - rest;
  answer.state.q[0] = (z - rest) * std::sqrt(m);
  answer.state.w[0] = v_[0] * std::sqrt(m);
}

void Specimen::tell_modes(double force, haptic::TissueAnswer& answer) {
  answer.model = modes_;
  double told = modes_.residual / kept_ * force;
  answer.model.residual = modes_.residual / kept_;
  for (std::size_t i = 0; i < shapes_.size(); ++i) {
    answer.model.modes[i].stiffness *= kept_;
    double q = 0, w = 0;
    for (std::size_t j = 0; j < u_.size(); ++j) {
      q += model_.mass * shapes_[i][j] * (u_[j] - base_);
      w += model_.mass * shapes_[i][j] * v_[j];
    }
    answer.state.q[i] = q;
    answer.state.w[i] = w;
    told += shapes_[i][0] * q;
  }
  answer.state.rest.z() = -smooth_rest(u_[0] - told);
}

void Specimen::tell(double force, haptic::TissueAnswer& answer) {
  answer.state.force.z() = -force;
  if (solid_) {
    solid_->tell(force, answer);
    answer.state.rest.z() = -smooth_rest(-answer.state.rest.z());
  } else if (u_.empty())
    answer.state.rest.z() = -smooth_rest(base_);
  else if (u_.size() == 1)
    tell_lump(force, answer);
  else
    tell_modes(force, answer);
}

}  // namespace palpate::bench
