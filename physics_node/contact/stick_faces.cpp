#include "physics_node/contact/stick_faces.h"

#include <algorithm>
#include <array>

#include "physics_node/collision/point_triangle.h"
#include "physics_node/contact/stick_search.h"

namespace palpate::physics {
namespace {

constexpr double inner = 1e-6;  // of the weights, for a point that lies in the triangle and not on its edge
constexpr double touching = 1e-9;  // Why: nearer, the direction from the face to the axis is rounding [m]

/// The nearest points of an axis and a triangle that it does not go through.
struct Nearest {
  Vec3 weight = Vec3::Zero();
  double t = 0, distance = 1e300;
};

void consider(const Nearest& other, Nearest& best) {
  if (other.distance < best.distance) best = other;
}

Nearest nearest_of(const Stick& stick, const std::array<Vec3, 3>& x) noexcept {
  Nearest best;
  for (const double t : {0.0, 1.0}) {
    const ClosestPoint closest = closest_point(stick.axis_point(t), x);
    consider({closest.weight, t, closest.distance}, best);
  }
  for (std::size_t e = 0; e < 3; ++e) {
    const std::size_t next = (e + 1) % 3;
    const SegmentPoints at = nearest_of_segments(x[e], x[next] - x[e], stick.A, stick.D);
    Nearest one;
    one.weight[static_cast<Eigen::Index>(e)] = 1 - at.s;
    one.weight[static_cast<Eigen::Index>(next)] += at.s;
    one.t = at.t;
    one.distance = (x[e] + at.s * (x[next] - x[e]) - stick.axis_point(at.t)).norm();
    consider(one, best);
  }
  return best;
}

/// Where the axis goes through the triangle. @return t of the axis; below 0: nowhere
double crossing(const Stick& stick, const std::array<Vec3, 3>& x, const Vec3& normal) noexcept {
  const double a = (stick.A - x[0]).dot(normal), b = (stick.A + stick.D - x[0]).dot(normal);
  if ((a < 0) == (b < 0)) return -1;
  const double t = a / (a - b);
  return closest_point(stick.axis_point(t), x).distance < 1e-9 ? t : -1;
}

}  // namespace

FaceHit meet(const Stick& stick, const std::array<Vec3, 3>& x) noexcept {
  FaceHit hit;
  const Vec3 area = (x[1] - x[0]).cross(x[2] - x[0]);
  if (!(area.squaredNorm() > 0)) return hit;
  const Vec3 normal = area.normalized();
  if (const double t = crossing(stick, x, normal); t >= 0) {
    // One end is behind: it comes out again by the way it went in.
    const double behind = -std::min((stick.A - x[0]).dot(normal), (stick.A + stick.D - x[0]).dot(normal));
    if (behind > stick.radius) return hit;
    return {true, closest_point(stick.axis_point(t), x).weight, t, -normal, stick.radius + behind};
  }
  const Nearest near = nearest_of(stick, x);
  if (near.distance >= stick.radius) return hit;
  const Vec3 point = near.weight[0] * x[0] + near.weight[1] * x[1] + near.weight[2] * x[2];
  const Vec3 away = stick.axis_point(near.t) - point;
  if (away.dot(normal) < 0) {
    if (near.weight.minCoeff() <= inner) return hit;  // beside it: another face's
    return {true, near.weight, near.t, -normal, stick.radius + near.distance};
  }
  const Vec3 push = near.distance > touching ? Vec3(-away / near.distance) : Vec3(-normal);
  return {true, near.weight, near.t, push, stick.radius - near.distance};
}

StickFaces::StickFaces(const Boundary& surface, BodyModel& model, double radius)
    : surface_(&surface),
      model_(&model),
      radius_(radius < 0.5 * model.body().spacing() ? radius : 0.5 * radius) {
  near_.reserve(surface.most_facets());
}

void StickFaces::list(const Stick& stick, double reach) noexcept {
  const double spacing = model_->body().spacing();
  // Why: from the middle of a facet to its corners, stretched twice.
  facets_around(stick, reach + 2 * spacing, *surface_, *model_, near_);
  listed_revision_ = surface_->revision();
}

bool StickFaces::has_changed(const Stick& stick, double reach) const noexcept {
  const double around = 0.5 * stick.D.norm() + reach + 2 * model_->body().spacing();
  return surface_->changed_near(stick.axis_point(0.5), around, listed_revision_, *model_);
}

LeadWork StickFaces::give_way(std::uint32_t facet, const Corners& corner, const FaceHit& hit,
                              const Stick& before, const Stick& now, const Vec3& origin, double dt,
                              ContactSum& sum) noexcept {
  constexpr std::size_t most = 24;  // three corners of eight masses
  std::array<std::uint32_t, most> which{};
  std::array<Index, most> cells{};
  std::array<Vec3, most> rest, x, v, v_move;
  std::array<double, most> weight{}, inverse_mass{};
  std::size_t n = 0;
  double W = 0, held = 0;
  Vec3 x_0 = Vec3::Zero(), v_p = Vec3::Zero(), v_moved = Vec3::Zero();
  for (std::size_t c = 0; c < 3; ++c) {
    const double w = hit.weight[static_cast<Eigen::Index>(c)];
    const Bearers by = surface_->bearers(facet, corner[c]);
    if (by.n == 0) {  // of the scenery, which stays
      x_0 += w * surface_->position(facet, corner[c], *model_);
      held += w * w / model_->body().law.mass;
      continue;
    }
    const auto rest_of = [this](Index node) { return model_->body().rest_position(node); };
    if (by.n == 1) x_0 += w * (surface_->rest(facet, corner[c]) - rest_of(by.node[0]));
    for (std::uint32_t b = 0; b < by.n; ++b) {
      std::size_t at = 0;
      while (at < n && cells[at] != by.node[b]) ++at;
      if (at == n) {
        which[n] = static_cast<std::uint32_t>(n);
        cells[n] = by.node[b];
        rest[n] = rest_of(by.node[b]);
        inverse_mass[n] = model_->body().inverse_mass[static_cast<std::size_t>(by.node[b])];
        ++n;
      }
      weight[at] += w * by.weight[b];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    W += weight[i] * weight[i] * inverse_mass[i];
    if (inverse_mass[i] == 0) held += weight[i] * weight[i] / node_mass(model_->body(), cells[i]);
  }
  LeadWork led;
  if (!(W > 0)) return led;  // nothing there gives way
  // The face is pushed as hard as if its held corners were free: by the corners that are alone, one of weight w would have to move by 1 / w
  // of the depth. So the stick comes out only as far as they move.
  const double yielding = W + held;
  model_->read({which.data(), n}, {cells.data(), n}, {rest.data(), n}, dt, {x.data(), n}, {v.data(), n},
               {v_move.data(), n});
  for (std::size_t i = 0; i < n; ++i)
    x_0 += weight[i] * x[i], v_p += weight[i] * v[i], v_moved += weight[i] * v_move[i];
  const Vec3 axis_motion = now.axis_point(hit.t) - before.axis_point(hit.t);
  const double depth = std::min(hit.depth, dt * (exit_speed + axis_motion.norm() / dt + v_moved.norm()));
  const double J = depth / (dt * yielding);
  std::array<NodalPush, most> pushes;
  for (std::size_t i = 0; i < n; ++i) pushes[i] = {cells[i], J * weight[i] * inverse_mass[i] * hit.push};
  model_->push({pushes.data(), n}, dt);
  const bool carried = (x_0 - before.axis_point(before.nearest(x_0))).norm() < now.radius + carried_within;
  const double given = J * (hit.push.dot(v_p) + 0.5 * J * W), by_hand = J * hit.push.dot(axis_motion) / dt;
  // A face that is carried takes all that the hand gives; one that is struck leaves a part.
  led.work = carried ? given : by_hand;
  led.lost = carried ? 0 : by_hand - given;
  const Vec3 at = x_0 + dt * (v_moved + J * W * hit.push);
  sum.add(-J * hit.push, at - origin);
  return led;
}

LeadWork StickFaces::lead(const Stick& before, const Stick& now, const Vec3& origin, double dt,
                          ContactSum& sum, std::uint32_t& contacts) noexcept {
  LeadWork led;
  const Stick then{before.A, before.D, radius_}, inner_stick{now.A, now.D, radius_};
  for (const std::uint32_t facet : near_) {
    if (!surface_->exists(facet)) continue;
    for (std::size_t half = 0; half < (surface_->is_triangle(facet) ? 1u : 2u); ++half) {
      const Corners corner{0, 1 + half, 2 + half};
      const FaceHit hit = meet(inner_stick, {surface_->position(facet, corner[0], *model_),
                                             surface_->position(facet, corner[1], *model_),
                                             surface_->position(facet, corner[2], *model_)});
      if (!hit.hit || hit.depth <= 0) continue;
      const LeadWork one = give_way(facet, corner, hit, then, inner_stick, origin, dt, sum);
      led.work += one.work;
      led.lost += one.lost;
      ++contacts;
    }
  }
  return led;
}

}  // namespace palpate::physics
