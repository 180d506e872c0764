#include "bench/haptic/solid_specimen.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bench/problems/held_block.h"

namespace palpate::bench {
namespace {

constexpr double beta = 5e-4;           // viscosity over modulus [s]
constexpr double patch_radius = 0.008;  // [m]
constexpr double shift = 100;           // [1/s^2]
constexpr int body_modes = 20;

physics::Body block() {
  return held_block({.size = Vec3(0.04, 0.04, 0.02), .edge = 0.005, .modulus = 15e3, .viscosity_time = beta});
}

}  // namespace

SolidSpecimen::SolidSpecimen(int modes)
    : model_(physics::make_body_model(block(), Precision::double_, Integrator::symplectic_euler)) {
  const physics::Body& body = model_->body();
  patch_ = patch_on_top(body, patch_radius);
  for (const auto& part : patch_) push_.push_back({part.cell, Vec3::Zero()});
  physics::LinearAnswer answer(body, shift);
  const physics::VibrationModes all = physics::lowest_modes(answer, {.n = body_modes});
  choose(physics::driving_point(answer, all, patch_), all, answer, modes);
}

/// Those whose steady answer along z is largest; the others only answer at once.
void SolidSpecimen::choose(const physics::DrivingPoint& point, const physics::VibrationModes& modes,
                           const physics::LinearAnswer& answer, int count) {
  const Eigen::Index of_body = modes.omega2.size();
  std::vector<Eigen::Index> order(static_cast<std::size_t>(point.omega2.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  const auto compliance = [&](Eigen::Index i) { return point.psi(2, i) * point.psi(2, i) / point.omega2[i]; };
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return compliance(a) > compliance(b); });
  const physics::Body& body = model_->body();
  for (const Eigen::Index i : order) {
    if (static_cast<int>(told_.size()) == count) {
      residual_ += compliance(i);
      continue;
    }
    Told told{{Vec3(0, 0, point.psi(2, i)), point.omega2[i], beta * point.omega2[i]}, {}};
    for (const physics::Index node : body.nodes()) {
      const Eigen::Index row = answer.row_of(node);
      for (Eigen::Index a = 0; a < 3; ++a) {
        const double shape =
            i < of_body ? modes.shape(3 * row + a, i) : point.added(3 * row + a, i - of_body);
        told.moment.push_back(answer.mass()[3 * row] * shape);
      }
    }
    told_.push_back(std::move(told));
  }
}

void SolidSpecimen::advance(double force) {
  for (std::size_t n = 0; n < push_.size(); ++n) push_[n].force = Vec3(0, 0, -force * patch_[n].share);
  model_->advance({.dt = step}, push_);
  measure();
}

void SolidSpecimen::measure() noexcept {
  depth_ = speed_ = 0;
  for (const auto& part : patch_) {
    depth_ -= part.share * model_->displacement(part.cell).z();
    speed_ -= part.share * model_->velocity(part.cell).z();
  }
}

void SolidSpecimen::tell(double force, haptic::TissueAnswer& answer) const {
  answer.model.n_modes = static_cast<std::uint32_t>(told_.size());
  answer.model.residual = residual_;
  answer.state.force.z() = -force;
  double known = residual_ * force;
  const auto nodes = model_->body().nodes();
  for (std::size_t i = 0; i < told_.size(); ++i) {
    double q = 0, w = 0;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const Eigen::Map<const Vec3> moment(&told_[i].moment[3 * n]);
      q += moment.dot(model_->displacement(nodes[n]));
      w += moment.dot(model_->velocity(nodes[n]));
    }
    answer.model.modes[i] = told_[i].mode;
    answer.state.q[i] = q;
    answer.state.w[i] = w;
    known -= told_[i].mode.psi.z() * q;
  }
  answer.state.rest.z() = known - depth_;
}

}  // namespace palpate::bench
