// Where tools begin and where their paths lead. Only paths that the scene writes down are known before the start.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "common/scene/body_spec.h"
#include "common/scene/device_spec.h"
#include "common/scene/force_model.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "physics_node/contact/held_shape.h"
#include "physics_node/remarks/enclosure.h"
#include "physics_node/remarks/remarks.h"
#include "physics_node/remarks/tool_points.h"

namespace palpate::physics {
namespace {

constexpr double fastest_hand = 3;  // [m/s]: a throw; pressing and cutting stay below 1
constexpr double far_away = 10;     // times the size of the bodies
constexpr double touch = 0.8;       // of the spacing: from anywhere on a facet a vertex is within 0.71 of it
constexpr std::size_t most_samples = 4000,
                      most_of_shape = 200;  // of a path; the latter cost a pass over all vertices each

std::vector<Vec3> samples_of(const DeviceSpec& device, double apart, std::size_t most = most_samples) {
  std::vector<Vec3> samples;
  double length = 0;
  for (std::size_t n = 1; n < device.waypoints.size(); ++n)
    length += (device.waypoints[n].p - device.waypoints[n - 1].p).norm();
  apart = std::max(apart, length / static_cast<double>(most));
  for (std::size_t n = 1; n < device.waypoints.size(); ++n) {
    const Vec3 &from = device.waypoints[n - 1].p, &to = device.waypoints[n].p;
    const int parts = std::max(1, static_cast<int>(std::ceil((to - from).norm() / apart)));
    for (int i = 0; i < parts; ++i) samples.push_back(from + (to - from) * i / parts);
  }
  if (!device.waypoints.empty()) samples.push_back(device.waypoints.back().p);
  return samples;
}

double reach_of(const ToolSpec& tool, double spacing) {
  return touch * spacing +
         (tool.shape == ToolShape::stick || tool.shape == ToolShape::forceps ? tool.radius : 0.0);
}

class ToolLook {
 public:
  ToolLook(const Scene& scene, const Bodies& bodies, const ToolSpec& tool)
      : scene_(scene), bodies_(bodies), tool_(tool), device_(scene.device(tool.device)) {
    for (const auto& body : bodies)
      if (body->body().name != tool.body || tool.shape != ToolShape::body) others_.emplace_back(*body);
    for (const Enclosure& other : others_) {
      finest_ = std::min(finest_, other.spacing());
      box_.extend(other.box());
    }
  }

  Remarks remarks() {
    if (others_.empty() || device_.waypoints.empty() || device_.driver != "simulated") return {};
    shape_ = tool_points(tool_, scene_, bodies_, 0.5 * finest_);
    const bool may_press_faces = tool_.shape == ToolShape::point || tool_.shape == ToolShape::stick;
    if (is_solid_tip(tool_.shape) || (may_press_faces && presses_faces())) held_ = held_shape(tool_);
    Remarks found;
    const Vec3 start = device_.waypoints.front().p;
    const bool inside = tool_.shape != ToolShape::body && begins_inside(start);
    if (inside)
      found.push_back(fmt::format(
          "{} begins inside tissue, and forces come on only outside of it; begin its path outside", who()));
    const double away = box_.exteriorDistance(start), size = box_.diagonal().norm();
    if (away > far_away * size) {
      found.push_back(
          fmt::format("{} begins {:.3g} m away from bodies of {:.3g} m; waypoints are in millimetres", who(),
                      away, size));
    } else if (!inside && !any_flies(scene_, bodies_) && !touches()) {
      found.push_back(fmt::format(
          "{}: its path never touches a body and stays {:.3g} mm away at the least; lead it to the surface",
          who(), 1e3 * least_distance()));
    }
    add_pace(found);
    return found;
  }

 private:
  std::string who() const { return fmt::format("{}: tool \"{}\"", tool_.place.text(), tool_.name); }

  bool presses_faces() const {
    return std::ranges::any_of(bodies_, [this](const auto& body) {
      return asks_for_faces(tool_, is_of_finite_elements(body->body()));
    });
  }
  bool begins_inside(const Vec3& start) const {
    return std::ranges::any_of(others_, [&](const Enclosure& other) {
      // The ball of a point lies outside, whatever its radius.
      return std::ranges::any_of(shape_, [&](const Vec3& p) { return other.contains(start + p); }) ||
             (held_ && held_->turns() && from_shape(other, start, 0) < -begins_within);
    });
  }

  bool touches() const {
    for (const Vec3& at : samples_of(device_, 0.5 * finest_))
      for (const Enclosure& other : others_)
        for (const Vec3& p : shape_)
          if (touches_at(other, at + p)) return true;
    if (!held_) return false;
    return std::ranges::any_of(samples_of(device_, 0.5 * finest_, most_of_shape), [&](const Vec3& at) {
      return std::ranges::any_of(others_, [&](const Enclosure& other) {
        return from_shape(other, at, reach_of(tool_, other.spacing())) <= reach_of(tool_, other.spacing());
      });
    });
  }
  /// Of the vertex that is nearest to a rigid shape, which may be far from all corners of that [m].
  /// @param reach  infinite where the body as a whole is farther
  double from_shape(const Enclosure& other, const Vec3& at, double reach) const {
    const Eigen::Matrix3d axes = held_->axes(Eigen::Quaterniond::Identity());
    const Vec3 origin = held_->origin(at, axes);
    double least = std::numeric_limits<double>::infinity();
    const Vec3 middle = origin + axes * held_->shape.bounds().center();
    if (other.box().exteriorDistance(middle) > held_->half_diagonal() + reach) return least;
    for (const Vec3& vertex : other.vertices())
      least = std::min(least, held_->shape.distance(axes.transpose() * (vertex - origin)).distance);
    return least;
  }
  bool touches_at(const Enclosure& other, const Vec3& p) const {
    // A stick thicker than a cell: the nearest vertex may be further than the bins reach.
    const double reach = reach_of(tool_, other.spacing());
    if (reach <= other.spacing()) return other.is_near(p, reach);
    return other.box().exteriorDistance(p) <= reach && other.distance(p) <= reach;
  }

  double least_distance() const {
    double least = std::numeric_limits<double>::infinity();
    const auto samples = samples_of(device_, std::max(4 * finest_, 1e-3 * box_.diagonal().norm()));
    const std::size_t stride = 1 + shape_.size() / 50;
    for (const Vec3& at : samples)
      for (const Enclosure& other : others_)
        for (std::size_t n = 0; n < shape_.size(); n += stride)
          least = std::min(least, other.distance(at + shape_[n]));
    if (!held_) return least;
    for (const Vec3& at : samples_of(device_, 4 * finest_, most_of_shape))
      for (const Enclosure& other : others_) least = std::min(least, from_shape(other, at, least));
    return least;
  }

  void add_pace(Remarks& found) const {
    const auto& path = device_.waypoints;
    for (std::size_t n = 1; n < path.size(); ++n) {
      const double speed = (path[n].p - path[n - 1].p).norm() / (path[n].t - path[n - 1].t);
      if (speed <= fastest_hand) continue;
      found.push_back(
          fmt::format("{} is led at {:.3g} m/s from {:.3g} to {:.3g} s, faster than a hand; waypoints are "
                      "[s, mm, mm, mm]",
                      who(), speed, path[n - 1].t, path[n].t));
      break;
    }
    if (scene_.seconds && path.back().t > *scene_.seconds + 1e-9)
      found.push_back(fmt::format(
          "{}: its path takes {:.4g} s, the scene ends after {:.4g}; give [scene] seconds = {:.4g}", who(),
          path.back().t, *scene_.seconds, path.back().t));
  }

  const Scene& scene_;
  const Bodies& bodies_;
  const ToolSpec& tool_;
  const DeviceSpec& device_;
  std::vector<Enclosure> others_;
  std::vector<Vec3> shape_;
  std::optional<HeldShape> held_;  // of a rigid shape, of which the points are the corners alone
  double finest_ = std::numeric_limits<double>::infinity();
  Eigen::AlignedBox3d box_;
};

/// A tip that would slip between the samples of the faces of cells so large: it presses their corners.
void add_tiny(const Scene& scene, const Bodies& bodies, const ToolSpec& tool, Remarks& found) {
  if (tool.shape != ToolShape::point || scene.physics->integrator == Integrator::backward_euler) return;
  for (const auto& body : bodies) {
    const double spacing = body->body().spacing();
    if (!asks_for_faces(tool, bears_by_faces(body->body())) || follows_shape(spacing, tool.radius)) continue;
    found.push_back(fmt::format(
        "{}: tool \"{}\", a tip of {:.3g} mm, presses cells of {:.3g} mm of body \"{}\" at their corners, "
        "as if it were two of them wide; cells of at most {:.3g} mm bear it by their faces",
        tool.place.text(), tool.name, 1e3 * tool.radius, 1e3 * spacing, body->body().name,
        2e3 * tool.radius));
  }
}

/// Planes through a sheet of springs turn with every spring that folds.
void add_buzzing(const Scene& scene, const Bodies& bodies, const ToolSpec& tool, Remarks& found) {
  if (tool.shape != ToolShape::point || force_model_of(tool) == ForceModel::tissue) return;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (is_surface_of_springs(bodies[b]->body()))
      found.push_back(fmt::format(
          "{}: tool \"{}\" feels planes, which shake on a surface of springs such as body \"{}\"; write "
          "force_model = \"tissue\"",
          tool.place.text(), tool.name, scene.bodies[b].name));
}

/// What is only there to be compared with.
void add_unbounded(const ToolSpec& tool, Remarks& found) {
  const ForceModel model = force_model_of(tool);
  if (tool.shape != ToolShape::point || (model != ForceModel::direct && model != ForceModel::raw_planes))
    return;
  found.push_back(
      fmt::format("{}: tool \"{}\" has a force_model of the papers, to be compared with: it presses masses "
                  "rather than faces, "
                  "and nothing bounds the energy that it puts into tissue; write force_model = \"tissue\"",
                  tool.place.text(), tool.name));
}

/// Under a solver that takes whole frames a tip presses masses.
void add_masses_under_it(const Scene& scene, const Bodies& bodies, const ToolSpec& tool, Remarks& found) {
  if (tool.shape != ToolShape::point || tool.contact ||
      scene.physics->integrator != Integrator::backward_euler)
    return;
  for (const auto& body : bodies)
    if (bears_by_faces(body->body()))
      found.push_back(fmt::format(
          "{}: tool \"{}\" presses masses of body \"{}\" under integrator = \"backward_euler\", as contact = "
          "\"nodes\" does, and bears two or three times as much as by its faces; explicit steps know these",
          tool.place.text(), tool.name, body->body().name));
}

/// Jaws between whose masses there is room for them.
void add_empty_jaws(const Scene& scene, const Bodies& bodies, const ToolSpec& tool, Remarks& found) {
  if (tool.shape != ToolShape::forceps) return;
  double finest = scene.bodies.empty() ? 0 : HUGE_VAL;
  for (const auto& body : bodies) finest = std::min(finest, body->body().spacing());
  if (tool.radius >= 0.5 * finest) return;
  found.push_back(fmt::format(
      "{}: tool \"{}\", jaws of {:.3g} mm, close between masses that lie {:.3g} mm apart and may hold none; "
      "radius_mm of {:.3g} or more holds some",
      tool.place.text(), tool.name, 1e3 * tool.radius, 1e3 * finest, 1e3 * finest));
}

}  // namespace

Remarks tool_remarks(const Scene& scene, const Bodies& bodies) {
  Remarks all;
  for (const ToolSpec& tool : scene.tools) {
    add_tiny(scene, bodies, tool, all);
    add_empty_jaws(scene, bodies, tool, all);
    add_buzzing(scene, bodies, tool, all);
    add_unbounded(tool, all);
    add_masses_under_it(scene, bodies, tool, all);
  }
  for (const ToolSpec& tool : scene.tools)
    for (auto& remark : ToolLook(scene, bodies, tool).remarks()) all.push_back(std::move(remark));
  return all;
}

}  // namespace palpate::physics
