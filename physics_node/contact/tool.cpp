#include "physics_node/contact/tool.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "common/message/vec3.h"

namespace palpate::physics {
namespace {

/// Stiffness of what a hand feels through a spring K that only ways stretch: K_t - K_t E (K + E^T K_t E)^-1 E^T K_t.
Mat6 through_spring(const Mat6& K_t, double K) noexcept {
  const Eigen::Matrix3d both = K_t.topLeftCorner<3, 3>() + K * Eigen::Matrix3d::Identity();
  const Eigen::Matrix<double, 6, 3> ways = K_t.leftCols<3>();
  return K_t - ways * both.ldlt().solve(ways.transpose());
}

}  // namespace

void Tool::note(const ToolState& state) noexcept {
  tick_ = state.tick;
  stamp_ns_ = state.stamp_ns;
  p_WT_ = state.p_WT;
  q_WT_ = state.q_WT;
}

void Tool::begin_patch(ContactPatch& patch, std::uint64_t frame, std::int64_t now_ns) const noexcept {
  patch.tool = index_;
  patch.tick = frame;
  patch.stamp_ns = now_ns;
  patch.answers = tick_;
  patch.answers_ns = stamp_ns_;
  patch.n_facets = 0;
  patch.contact_set = 0;
}

void Tool::write_wrench(ToolWrench& out, std::uint64_t frame, std::int64_t now_ns, double t) const noexcept {
  Wrench now = wrench();
  out.tool = index_;
  out.tick = frame;
  out.stamp_ns = now_ns;
  out.answers = tick_;
  out.answers_ns = stamp_ns_;
  out.t = t;
  out.p_WT = p_WT_;
  out.q_WT = q_WT_;
  out.tip = array(tip());
  out.stiffness = {};
  out.normal = {};
  out.stretch = 0;
  if (const TangentEstimate* felt = tangent()) {
    now.force = felt->wrench().head<3>();
    now.moment = felt->wrench().tail<3>() + (tip() - set_point_).cross(now.force);
    const double K = spring_to_hand();
    if (std::isfinite(K)) out.p_WT = array(tip() - now.force / K);
    const NortonSpring* surface = spring();
    const Mat6 K_t = surface != nullptr ? surface->tangent() : felt->stiffness();
    Eigen::Map<Mat6>(out.stiffness.data()) = std::isfinite(K) ? through_spring(K_t, K) : K_t;  // symmetric
    if (surface != nullptr) {
      out.normal = array(surface->normal);
      out.stretch = surface->normal.dot(tip() - vec(out.p_WT)) - surface->gap;
    }
  }
  out.force = array(now.force);
  out.moment = array(now.moment);
  out.set_point = array(set_point_);
  out.n_contacts = contacts();
}

}  // namespace palpate::physics
