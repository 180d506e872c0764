#include "physics_node/contact/face_press.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "physics_node/collision/point_triangle.h"

namespace palpate::physics {
namespace {

constexpr double stiffness_in_cells =
    100;  // k h / E. Why: p / k is then below 1 % of the depth; see docs/benchmarks.md
// Why: with 24 forces differ by 1 % at most, and cost five times as much. A stick bears along its side on many, across on few.
constexpr double samples_in_size = 10, samples_in_side = 5;
constexpr std::size_t most_bearings = 4 * FacePress::most_facets * 8;
constexpr double far = std::numeric_limits<double>::infinity();

double stiffest(const Body& body) {
  double modulus = body.law.modulus;
  for (const ElementLaw& law : body.laws) modulus = std::max(modulus, law.modulus);
  return modulus;
}

}  // namespace

ShapePose pose_along(const Vec3& tip, const Vec3& normal) noexcept {
  ShapePose pose;
  pose.tip = tip;
  const Vec3 other = std::abs(normal.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY();
  pose.axes.col(2) = normal;
  pose.axes.col(0) = (other - other.dot(normal) * normal).normalized();
  pose.axes.col(1) = normal.cross(pose.axes.col(0));
  return pose;
}

ShapePose pose_along(const Vec3& tip, const Vec3& normal, const Eigen::Matrix3d& attitude) noexcept {
  ShapePose pose = pose_along(tip, normal);
  pose.attitude = pose.axes.transpose() * attitude;
  return pose;
}

FacePress::FacePress(std::vector<PressedBody> bodies, const RigidShape& shape)
    : bodies_(std::move(bodies)),
      shape_(shape),
      turns_(shape.kind() != RigidShape::Kind::sphere),
      begins_(bodies_.size() + 1, 0) {
  double finest = shape.size();
  for (const PressedBody& pressed : bodies_) {
    const Body& body = pressed.moving->body();
    k_.push_back(stiffness_in_cells * stiffest(body) / body.spacing());
    finest = std::min(finest, body.spacing());
    widest_ = std::max(widest_, body.spacing());
  }
  margin_ = 0.1 * finest;
  candidates_.reserve(most_facets);
  faces_.reserve(most_facets);
  nodes_.reserve(4 * most_facets);
  vertices_.reserve(4 * most_facets);
  corners_.reserve(4 * most_facets);
  bearings_.reserve(most_bearings);
  order_.reserve(most_bearings);
  listed_.reserve(most_facets);
  samples_.reserve(most_samples);
  near_.reserve(most_samples);
  forces_.reserve(4 * most_facets);
  bears_.reserve(4 * most_facets);
  for (int n = fewest_a_side; n <= most_a_side; ++n)
    for (int at = 0; at < n * n; ++at) {
      const double p = (at % n + 0.5) / n, q = (at / n + 0.5) / n;
      weights_[static_cast<std::size_t>(n)].push_back({(1 - p) * (1 - q), p * (1 - q), p * q, (1 - p) * q});
    }
}

double FacePress::reach() const noexcept {
  // Why twice the spacing: from the middle of a facet to its corners, stretched.
  const Eigen::AlignedBox3d box = shape_.bounds();
  const double size = turns_ ? box.max().cwiseMax(-box.min()).norm() : box.max().head<2>().norm();
  return size + std::max(0.0, z_) + around() + 2 * widest_;
}

/// What tissue under the tip and the tip may move by in a frame. [m]
double FacePress::around() const noexcept { return std::max(0.002, 0.25 * shape_.size()) + way_; }

double FacePress::sample_spacing(double face_area) const noexcept {
  const double side = std::sqrt(face_area);
  const double most = shape_.kind() == RigidShape::Kind::capsule ? samples_in_side : samples_in_size;
  return side / std::clamp(std::ceil(most * side / shape_.size()), 1.0 * fewest_a_side, 1.0 * most_a_side);
}

/// Samples along a side of a face.
std::uint8_t FacePress::a_side(double face_area) const noexcept {
  return static_cast<std::uint8_t>(std::clamp<long>(
      std::lround(std::sqrt(face_area) / sample_spacing(face_area)), fewest_a_side, most_a_side));
}

/// From the shape, of a point in the frame of the pose.
RigidShape::Distance FacePress::distance(const Vec3& p) const noexcept {
  if (!turns_) return shape_.distance(p);
  RigidShape::Distance d = shape_.distance(attitude_.transpose() * p);
  d.outward = attitude_ * d.outward;
  return d;
}

const FacePress::Weights& FacePress::weights(const Face& face, std::uint32_t at) const noexcept {
  return weights_[face.n][at];
}

Vec3 FacePress::at(const Face& face, const Weights& w) const noexcept {
  const Vec3 &a = vertices_[face.vertex[0]].moved, &b = vertices_[face.vertex[1]].moved,
             &c = vertices_[face.vertex[2]].moved, &d = vertices_[face.vertex[3]].moved;
  Vec3 x;  // Why by component: an expression of vectors leaves calls behind here
  for (int i = 0; i < 3; ++i) x[i] = w[0] * a[i] + w[1] * b[i] + w[2] * c[i] + w[3] * d[i];
  return x;
}

/// From outside, by the samples, middles and corners of faces that look at the shape.
void FacePress::find_depth(const ShapePose& pose) noexcept {
  const auto local = [&](const Vec3& x) { return Vec3(pose.axes.transpose() * (x - pose.tip)); };
  double highest = -far;
  for (const Facet& facet : candidates_)
    highest = std::max(highest, local(surface(facet).centroid(facet.number, moving(facet))).z());
  z_ = -highest - widest_;
  // Why 64: from one shape's size away a sphere is reached within 1 % in some ten.
  for (int n = 0; n < 64; ++n) {
    double nearest = far;
    for (const Facet& facet : candidates_) {
      const auto [middle, area] = surface(facet).centroid_and_area(facet.number, moving(facet));
      const Vec3 p = local(middle) + z_ * Vec3::UnitZ();
      const RigidShape::Distance d = distance(p);
      if ((pose.axes.transpose() * area).dot(d.outward) >= 0 || d.outward.z() >= 0) continue;
      nearest = std::min(nearest, d.distance);
      std::array<Vec3, 4> corner;
      double reach = 0;
      for (std::size_t c = 0; c < 4; ++c) {
        corner[c] = local(position(facet, c)) + z_ * Vec3::UnitZ();
        reach = std::max(reach, (corner[c] - p).norm());
        nearest = std::min(nearest, distance(corner[c]).distance);
      }
      if (d.distance - reach > nearest) continue;
      for (const Weights& w : weights_[a_side(surface(facet).rest_area(facet.number).norm())])
        nearest = std::min(
            nearest,
            distance(w[0] * corner[0] + w[1] * corner[1] + w[2] * corner[2] + w[3] * corner[3]).distance);
    }
    if (!(nearest < far)) return;
    z_ += nearest;
    if (nearest < margin_) return;
  }
}

FacePress::WayOut FacePress::way_out(const Vec3& from) const noexcept {
  WayOut out{far};
  for (const Facet& facet : candidates_) {
    if (!surface(facet).exists(facet.number)) continue;
    const auto [centroid, area] = surface(facet).centroid_and_area(facet.number, moving(facet));
    // Why twice the spacing: from the middle of a face to its corners, stretched.
    if ((centroid - from).norm() > out.distance + 2 * spacing(facet)) continue;
    std::array<Vec3, 4> corner;
    for (std::size_t c = 0; c < 4; ++c) corner[c] = position(facet, c);
    for (const Triangle& half :
         {Triangle{corner[0], corner[1], corner[2]}, Triangle{corner[0], corner[2], corner[3]}}) {
      const ClosestPoint to = closest_point(from, half);
      if (to.distance < out.distance && to.distance > 0 && to.away.dot(area) > 0)
        out = {to.distance, to.away / to.distance};
    }
  }
  return out;
}

void FacePress::take_candidates(std::span<const std::vector<std::uint32_t>> facets) noexcept {
  candidates_.clear();
  for (std::uint32_t body = 0; body < facets.size(); ++body)
    for (const std::uint32_t facet : facets[body])
      if (candidates_.size() < most_facets) candidates_.push_back({body, facet});
}

void FacePress::list(const ShapePose& pose, double way) noexcept {
  way_ = way;
  attitude_ = pose.attitude;
  faces_.clear();
  listed_.clear();
  if (!touching_) find_depth(pose);
  for (const Facet& facet : candidates_) {
    const Boundary& surface = this->surface(facet);
    if (!surface.exists(facet.number) || faces_.size() == most_facets) continue;
    Face face;
    std::array<Vec3, 4> corner;
    for (std::size_t c = 0; c < 4; ++c) corner[c] = position(facet, c);
    const Vec3 middle = (corner[0] + corner[1] + corner[2] + corner[3]) / 4;
    const Vec3 p = pose.axes.transpose() * (middle - pose.tip) + z_ * Vec3::UnitZ();
    const double gap = distance(p).distance;
    // Why twice the spacing: from the middle of a face to its corners, stretched.
    if (gap > 2 * spacing(facet) + around()) continue;
    for (const Vec3& of : corner) face.reach = std::max(face.reach, (of - middle).norm());
    if (gap > face.reach + around()) continue;
    face.k = k_[facet.body];
    face.area = surface.rest_area(facet.number).norm();
    if (!(face.area > 0)) continue;
    face.triangle = surface.is_triangle(facet.number);
    face.n = a_side(face.area);
    faces_.push_back(face);
    listed_.push_back(facet);
  }
  // A skin torn to pieces may have more nodes than there is room for.
  for (find_vertices(); !find_nodes(); find_vertices()) {
    faces_.resize(faces_.size() / 2, Face{});
    listed_.resize(faces_.size(), Facet{});
  }
}

/// Equal corners become one vertex, in the order of their numbers.
void FacePress::find_vertices() noexcept {
  corners_.clear();
  vertices_.clear();
  bearings_.clear();
  for (std::uint32_t f = 0; f < listed_.size(); ++f)
    for (std::uint32_t c = 0; c < 4; ++c)
      corners_.push_back({listed_[f].body, surface(listed_[f]).corner(listed_[f].number, c), 4 * f + c});
  std::sort(corners_.begin(), corners_.end());
  for (std::size_t n = 0; n < corners_.size();) {
    const Corner first = corners_[n];
    const Facet& facet = listed_[first.number / 4];
    const std::size_t c = first.number % 4;
    const Bearers by = surface(facet).bearers(facet.number, c);
    Vertex vertex{.body = facet.body, .first = static_cast<std::uint32_t>(bearings_.size()), .n = by.n};
    vertex.offset = surface(facet).rest(facet.number, c);
    // Weights of a cell hold the place itself.
    const Body& body = moving(facet).body();
    if (by.n > 0) vertex.offset -= by.mean([&body](Index node) { return body.rest_position(node); });
    if (by.n > 1) vertex.offset.setZero();
    for (std::uint32_t b = 0; b < by.n; ++b)
      bearings_.push_back({static_cast<std::uint32_t>(by.node[b]), by.weight[b]});
    const auto number = static_cast<std::uint32_t>(vertices_.size());
    vertices_.push_back(vertex);
    for (; n < corners_.size() && corners_[n].body == first.body && corners_[n].corner == first.corner; ++n)
      faces_[corners_[n].number / 4].vertex[corners_[n].number % 4] = number;
  }
}

/// Those that carry vertices, in storage order. @return false: there is no room for all
bool FacePress::find_nodes() noexcept {
  nodes_.clear();
  order_.clear();
  for (const Vertex& vertex : vertices_)
    for (std::uint32_t b = vertex.first; b < vertex.first + vertex.n; ++b)
      order_.push_back({vertex.body, static_cast<Index>(bearings_[b].node), b});
  std::sort(order_.begin(), order_.end());
  for (std::size_t n = 0; n < order_.size();) {
    const auto [body, cell, bearing] = order_[n];
    if (nodes_.size() == nodes_.capacity()) return false;
    for (; n < order_.size() && order_[n].body == body && order_[n].cell == cell; ++n)
      bearings_[order_[n].bearing].node = static_cast<std::uint32_t>(nodes_.size());
    const NodeMotion* moving = bodies_[body].moving;
    nodes_.push_back({.moving = moving,
                      .body = body,
                      .cell = cell,
                      .inverse_mass = moving->body().inverse_mass[static_cast<std::size_t>(cell)]});
  }
  return true;
}

void FacePress::note_motion(bool verlet) noexcept {
  for (Node& node : nodes_) {
    node.began = node.moving->position(node.cell);
    if (!verlet) {
      node.v = node.moving->velocity(node.cell);
      continue;
    }
    // With velocity_verlet what a body shows is half a step ahead.
    for (int a = 0; a < 3; ++a) {
      const NodalForce one{node.cell, Vec3::Unit(a)};
      node.v[a] = node.moving->power({&one, 1});
    }
  }
}

double FacePress::power_before() const noexcept {
  double sum = 0;
  for (std::size_t n = 0; n < forces_.size(); ++n) {
    const Node& node = nodes_[bears_[n]];
    if (node.inverse_mass > 0) sum += forces_[n].force.dot(node.v);
  }
  return sum;
}

Vec3 FacePress::way(double dt, const Vec3& force) const noexcept {
  const double pressed = borne_.dot(normal_);
  if (!(pressed < 0)) return Vec3::Zero();
  Vec3 sum = Vec3::Zero();
  for (std::size_t n = 0; n < forces_.size(); ++n) {
    const Node& node = nodes_[bears_[n]];
    const Vec3 at_end = node.moving->position(node.cell) + dt * dt * node.inverse_mass * forces_[n].force;
    sum += forces_[n].force.dot(normal_) / pressed * (at_end - node.began);
  }
  return sum + dt * dt * mobility() * (force - borne_);
}

double FacePress::mobility() const noexcept {
  double sum = 0;
  for (std::size_t n = 0; n < forces_.size(); ++n) {
    const double along = forces_[n].force.dot(normal_);
    sum += along * along * nodes_[bears_[n]].inverse_mass;
  }
  const double pressed = borne_.dot(normal_);
  return pressed < 0 ? sum / (pressed * pressed) : 0;
}

double FacePress::pressed(std::size_t body) const noexcept {
  double sum = 0;
  for (const NodalForce& nodal : forces(body)) sum -= nodal.force.dot(normal_);
  return sum;
}

void FacePress::release() noexcept {
  touching_ = false;
  z_ = 0;
  drop_forces();
}

void FacePress::drop_forces() noexcept {
  area_ = overlap_ = across_ = 0;
  forces_.clear();
  bears_.clear();
  std::fill(begins_.begin(), begins_.end(), 0);
}

}  // namespace palpate::physics
