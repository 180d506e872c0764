#include "physics_node/contact/blade_inside.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace palpate::physics {
namespace {

constexpr double looks_after = 2.5e-4;            // of way [m]
constexpr std::size_t box_facets_a_frame = 4000;  // Why: some 20 ns each
constexpr std::size_t angles_a_frame = 2000;      // Why: some 40 ns each

double solid_angle(const Vec3& x, const Vec3& y, const Vec3& z) noexcept {
  const double l = x.norm(), m = y.norm(), n = z.norm();
  return 2 * std::atan2(x.dot(y.cross(z)), l * m * n + x.dot(y) * n + y.dot(z) * l + z.dot(x) * m);
}

}  // namespace

BladeInside::BladeInside(const std::vector<TouchableBody>& bodies, std::vector<std::size_t> passed,
                         double length)
    : bodies_(bodies),
      passed_(std::move(passed)),
      length_(length),
      area_(bodies.size(), 0),
      inside_(passed_.size()) {
  point_.fill(Vec3::Zero()), before_.fill(Vec3::Zero());
  reset();
}

void BladeInside::reset() noexcept {
  let_go();
  std::ranges::fill(area_, 0.0);
  for (auto& inside : inside_) inside.fill(false);
}

/// @return false: it stands about where the last look was
bool BladeInside::begin_look(const BladeFrame& frame) noexcept {
  Points now;
  double way = 0;
  for (std::size_t n = 0; n < n_points; ++n) {
    now[n] = frame.tip + (static_cast<double>(n) + 0.5) / n_points * length_ * frame.along;
    way = std::max(way, (now[n] - point_[n]).norm());
  }
  if (seen_ && way < looks_after) return false;
  before_ = seen_ ? point_ : now;
  point_ = now;
  along_ = frame.along;
  if (!seen_)
    for (auto& inside : inside_) inside.fill(false);
  seen_ = true;
  at_ = 0;
  part_ = Part::box;
  facet_ = 0;
  box_.setEmpty();
  return true;
}

std::uint32_t BladeInside::end_of_part(std::size_t facets) const noexcept {
  return static_cast<std::uint32_t>(std::min(facet_ + facets, surface().surface().facets.size()));
}

void BladeInside::find_box() noexcept {
  for (const std::uint32_t end = end_of_part(box_facets_a_frame); facet_ < end; ++facet_)
    for (std::size_t c = 0; c < 4; ++c) box_.extend(corner(facet_, c));
  if (facet_ < surface().surface().facets.size()) return;
  facet_ = 0;
  angle_.fill(0);
  if (std::ranges::any_of(point_, [this](const Vec3& p) { return box_.contains(p); }))
    part_ = Part::angles;
  else
    end_body();
}

void BladeInside::add_angles() noexcept {
  for (const std::uint32_t end = end_of_part(angles_a_frame / (2 * n_points)); facet_ < end; ++facet_) {
    if (!surface().exists(facet_)) continue;
    const Vec3 a = corner(facet_, 0), b = corner(facet_, 1), c = corner(facet_, 2), d = corner(facet_, 3);
    const bool is_triangle = surface().is_triangle(facet_);
    for (std::size_t n = 0; n < n_points; ++n) {
      const Vec3& p = point_[n];
      angle_[n] += solid_angle(a - p, b - p, c - p);
      if (!is_triangle) angle_[n] += solid_angle(a - p, c - p, d - p);
    }
  }
  if (facet_ == surface().surface().facets.size()) end_body();
}

/// Half of the way between two looks counts for each.
void BladeInside::end_body() noexcept {
  const double width = length_ / n_points;
  for (std::size_t n = 0; n < n_points; ++n) {
    const bool is_inside = std::abs(angle_[n]) > 2 * std::numbers::pi;
    const Vec3 way = point_[n] - before_[n];
    const double across = (way - along_.dot(way) * along_).norm();
    const int ends = (is_inside ? 1 : 0) + (inside_[at_][n] ? 1 : 0);
    area_[passed_[at_]] += 0.5 * ends * width * across;
    inside_[at_][n] = is_inside;
  }
  ++at_;
  part_ = Part::box;
  facet_ = 0;
  box_.setEmpty();
  angle_.fill(0);
}

void BladeInside::follow(const BladeFrame& frame) noexcept {
  if (passed_.empty()) return;
  if (!looking_ && !(looking_ = begin_look(frame))) return;
  if (part_ == Part::box)
    find_box();
  else
    add_angles();
  if (at_ == passed_.size()) looking_ = false;
}

}  // namespace palpate::physics
