#include "physics_node/reduced/body_modes.h"

#include <algorithm>
#include <cmath>

#include "physics_node/reduced/lowest_modes.h"

namespace palpate::physics {
namespace {

constexpr double shift_of_modes = 100;  // of what nothing holds [1/s^2]

}  // namespace

BodyModes::BodyModes(const Body& body, int most, const Crew& crew) : body_(&body), beta_(damper_time(body)) {
  if (!body.solid || most <= 0) return;
  LinearAnswer answer(body, shift_of_modes, crew);
  const VibrationModes modes = lowest_modes(answer, {.n = most}, crew);
  if (!modes.converged) return;
  for (Eigen::Index i = 0; i < modes.omega2.size(); ++i) omega2_.push_back(std::max(0.0, modes.omega2[i]));
  at_.assign(static_cast<std::size_t>(body.capacity()), -1);
  for (const Index node : body.nodes()) {
    at_[static_cast<std::size_t>(node)] = static_cast<std::int64_t>(moment_.size());
    const Eigen::Index row = answer.row_of(node);
    for (std::size_t i = 0; i < size(); ++i) {
      Vec3 moment = Vec3::Zero();
      for (Eigen::Index a = 0; a < 3 && row >= 0; ++a)
        moment[a] = answer.mass()[3 * row + a] * modes.shape(3 * row + a, static_cast<Eigen::Index>(i));
      moment_.push_back(moment);
    }
  }
}

Vec3 BodyModes::shape(std::size_t i, Index node) const noexcept {
  const std::int64_t at = at_[static_cast<std::size_t>(node)];
  const double w = body_->inverse_mass[static_cast<std::size_t>(node)];
  if (at < 0) return Vec3::Zero();
  return w * moment_[static_cast<std::size_t>(at) + i];
}

void BodyModes::measure(const NodeMotion& moving, std::span<double> q, std::span<double> w) const noexcept {
  const std::size_t n = size();
  std::fill_n(q.begin(), n, 0.0);
  std::fill_n(w.begin(), n, 0.0);
  std::size_t at = 0;
  for (const Index node : body_->nodes()) {
    const Vec3 u = moving.displacement(node), v = moving.velocity(node);
    for (std::size_t i = 0; i < n; ++i) {
      q[i] += moment_[at + i].dot(u);
      w[i] += moment_[at + i].dot(v);
    }
    at += n;
  }
}

}  // namespace palpate::physics
