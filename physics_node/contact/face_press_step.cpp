#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "physics_node/contact/face_press.h"

namespace palpate::physics {
namespace {

constexpr double lets_go_by = 2;         // of -o . N: samples bear fully up to 60 degrees
constexpr double balance_within = 1e-4;  // of the force; what is left is made up by a factor
constexpr int most_starts = 20;  // of the sweeps, while the depth leaves the samples that were collected
constexpr int most_looks = 60;   // Why: a first touch from far takes some twenty, later steps two or three
constexpr double near_in_margin = 0.25;  // Why: a first sweep moves nodes by more, the others by less
constexpr double unbounded = std::numeric_limits<double>::infinity();

/// As deep as the shape's tip is.
Vec3 raised(const Vec3& x, double z) noexcept { return {x.x(), x.y(), x.z() + z}; }

}  // namespace

void FacePress::read_nodes(const ShapePose& pose) noexcept {
  for (Node& node : nodes_) {
    node.moved = node.x = pose.axes.transpose() * (node.moving->position(node.cell) - pose.tip);
    node.f.setZero();
    node.theta = 0;
  }
  for (Vertex& vertex : vertices_) {
    vertex.apart = pose.axes.transpose() * (vertex.n > 0 ? vertex.offset : Vec3(vertex.offset - pose.tip));
    vertex.f.setZero();
    vertex.theta = 0;
  }
  move_vertices();
  for (Vertex& vertex : vertices_) vertex.seen = vertex.x = vertex.moved;
}

/// To where their nodes have moved.
void FacePress::move_vertices() noexcept {
  for (Vertex& vertex : vertices_) {
    vertex.moved = vertex.apart;
    for (std::uint32_t b = vertex.first; b < vertex.first + vertex.n; ++b)
      vertex.moved += bearings_[b].weight * nodes_[bearings_[b].node].moved;
  }
}

/// Samples that the shape may meet while the depth changes by no more than the margin.
void FacePress::collect() noexcept {
  samples_.clear();
  collected_z_ = z_;
  for (std::uint32_t f = 0; f < faces_.size(); ++f) {
    Face& face = faces_[f];
    const Vec3 &a = vertices_[face.vertex[0]].x, &b = vertices_[face.vertex[1]].x,
               &c = vertices_[face.vertex[2]].x, &d = vertices_[face.vertex[3]].x;
    const Vec3 middle = raised(0.25 * (a + b + c + d), z_);
    // Why more than the reach: corners have moved since the frame began.
    if (distance(middle).distance > 1.1 * face.reach + 2 * margin_) continue;
    face.normal = (c - a).cross(d - b).normalized();
    const int n = face.n * face.n;
    for (int at_n = 0; at_n < n && samples_.size() < most_samples; ++at_n) {
      const Weights& w = weights(face, static_cast<std::uint32_t>(at_n));
      Sample sample{.face = f, .w = w};
      sample.x = w[0] * a + w[1] * b + w[2] * c + w[3] * d;
      sample.clear = distance(raised(sample.x, z_)).distance;
      if (sample.clear > 2 * margin_) continue;
      // The map of a square on a triangle, whose last corners are one.
      const double density = face.triangle ? 2 * (w[0] + w[1]) : 1;
      sample.k = face.k * density * face.area / n;
      samples_.push_back(sample);
    }
  }
  seen_z_ = z_, moved_by_ = 0;
  keep_near(touching_ ? near_in_margin * margin_ : unbounded);
}

double FacePress::part(const Sample& sample) const noexcept {
  const Face& face = faces_[sample.face];
  double theta = 0;
  for (std::size_t k = 0; k < 4; ++k) theta += sample.w[k] * vertices_[face.vertex[k]].theta;
  return 1 / (1 + theta);
}

/// Only these are looked at until something has moved that far: a distance changes by no more than what has moved, so what is not near
/// stays outside, and does not press.
void FacePress::keep_near(double within) noexcept {
  near_within_ = within;
  near_.clear();
  for (std::uint32_t s = 0; s < samples_.size(); ++s) {
    if (samples_[s].clear <= within || samples_[s].p > 0)
      near_.push_back(s);
    else
      samples_[s].next = 0;
  }
}

void FacePress::look_at_all(double z) noexcept {
  for (Vertex& vertex : vertices_) vertex.seen = vertex.moved;
  for (Sample& sample : samples_) {
    sample.x = at(faces_[sample.face], sample.w);
    sample.part = part(sample);
    sample.clear = distance(raised(sample.x, z)).distance;
  }
  seen_z_ = z, moved_by_ = 0;
  keep_near(near_in_margin * margin_);
}

/// At a depth: what samples press with, and how that changes with depth.
FacePress::Balance FacePress::look(double z) noexcept {
  if (std::abs(z - seen_z_) + moved_by_ >= near_within_) look_at_all(z);
  Balance sum;
  for (const std::uint32_t s : near_) {
    Sample& sample = samples_[s];
    const RigidShape::Distance d = distance(raised(sample.x, z));
    sample.o = d.outward;
    sample.c = std::clamp(-lets_go_by * d.outward.dot(faces_[sample.face].normal), 0.0, 1.0);
    const double k = sample.part * sample.k * sample.c;
    sample.next = std::max(0.0, (1 - sample.part) * sample.p - k * d.distance);
    if (sample.next <= 0) continue;
    sum.force -= sample.next * d.outward.z();
    sum.slope += k * d.outward.z() * d.outward.z();
  }
  return sum;
}

/// From the shape to the nearest sample that looks at it, of all that are listed. No sample of a face is nearer
/// than its middle less what its corners are away from that. [m]
double FacePress::nearest() const noexcept {
  double least = unbounded;
  for (const Face& face : faces_) {
    Vec3 middle = Vec3::Zero();
    for (const std::uint32_t v : face.vertex) middle += 0.25 * vertices_[v].moved;
    double around = 0;
    for (const std::uint32_t v : face.vertex)
      around = std::max(around, (vertices_[v].moved - middle).squaredNorm());
    if (distance(raised(middle, z_)).distance - std::sqrt(around) > least) continue;
    const Vec3 normal = (vertices_[face.vertex[2]].x - vertices_[face.vertex[0]].x)
                            .cross(vertices_[face.vertex[3]].x - vertices_[face.vertex[1]].x);
    for (int n = 0; n < face.n * face.n; ++n) {
      const Vec3 x = at(face, weights(face, static_cast<std::uint32_t>(n)));
      const RigidShape::Distance d = distance(raised(x, z_));
      if (d.outward.z() < 0 && d.outward.dot(normal) < 0) least = std::min(least, d.distance);
    }
  }
  return least;
}

/// Finds the depth at which samples press as they are pressed, by Newton's method between bounds.
FacePress::Found FacePress::balance(const PressBy& by) noexcept {
  double low = -unbounded, high = unbounded;
  for (int n = 0; n < most_looks; ++n) {
    const Balance now = look(z_);
    const double force = by.at(z_);
    if (std::abs(now.force - force) <= balance_within * force) return Found::here;
    (now.force < force ? low : high) = z_;
    double to = z_ + (force - now.force) / (now.slope + by.fall(z_));
    if (!(now.slope > 0)) {  // beside or above everything
      const double gap = nearest();
      if (!(gap < unbounded)) return Found::nothing;
      to = z_ + std::max(gap, 0.0) + 1e-3 * margin_;
    }
    if (to <= low || to >= high) to = 0.5 * (low + high);
    if (!std::isfinite(to)) return Found::nothing;
    if (std::abs(to - collected_z_) > margin_) {
      z_ = now.slope > 0 ? std::clamp(to, collected_z_ - margin_, collected_z_ + margin_) : to;
      return Found::elsewhere;
    }
    z_ = to;
  }
  return look(z_).force > 0 ? Found::here : Found::nothing;
}

/// dt^2 K_i / m_i, and the parts by it. @param all  of all samples, rather than of what presses now
void FacePress::lump(double dt, bool all) noexcept {
  for (Node& node : nodes_) node.theta = 0;
  for (Vertex& vertex : vertices_) vertex.K = vertex.theta = 0;
  for (const std::uint32_t s : near_) {
    const Sample& sample = samples_[s];
    if (!all && sample.next <= 0) continue;
    const Face& face = faces_[sample.face];
    for (std::size_t k = 0; k < 4; ++k) vertices_[face.vertex[k]].K += sample.w[k] * sample.k * sample.c;
  }
  const auto each_bearing = [this](const auto& visit) {
    for (Vertex& vertex : vertices_)
      for (std::uint32_t b = vertex.first; b < vertex.first + vertex.n; ++b)
        visit(vertex, nodes_[bearings_[b].node], std::abs(bearings_[b].weight));
  };
  each_bearing([&](const Vertex& vertex, Node& node, double w) {
    node.theta += dt * dt * node.inverse_mass * w * vertex.K;
  });
  each_bearing([](Vertex& vertex, const Node& node, double w) { vertex.theta += w * node.theta; });
  for (const std::uint32_t s : near_) samples_[s].part = part(samples_[s]);
}

void FacePress::place_samples() noexcept {
  for (const std::uint32_t s : near_) samples_[s].x = at(faces_[samples_[s].face], samples_[s].w);
}

FacePress::Found FacePress::sweep(const PressBy& by, double dt, bool first) noexcept {
  place_samples();
  look(z_);
  const bool anew = first && !touching_;
  lump(dt, anew);  // Why of all: before a first touch nothing presses yet
  if (const Found found = balance(by); found != Found::here) return found;
  if (anew) {
    lump(dt, false);
    if (const Found found = balance(by); found != Found::here) return found;
  }
  double pressed = 0;
  for (const std::uint32_t s : near_) pressed -= samples_[s].next * samples_[s].o.z();
  const double force = by.at(z_);
  if (!(pressed > 0 && force > 0)) return Found::nothing;
  for (Node& node : nodes_) node.f.setZero();
  for (Vertex& vertex : vertices_) vertex.f.setZero();
  for (const std::uint32_t s : near_) {
    Sample& sample = samples_[s];
    sample.p = force / pressed * sample.next;
    if (sample.p <= 0) continue;
    const Face& face = faces_[sample.face];
    const Weights& w = sample.w;
    for (std::size_t k = 0; k < 4; ++k) vertices_[face.vertex[k]].f += w[k] * sample.p * sample.o;
  }
  for (const Vertex& vertex : vertices_)
    for (std::uint32_t b = vertex.first; b < vertex.first + vertex.n; ++b)
      nodes_[bearings_[b].node].f += bearings_[b].weight * vertex.f;
  for (Node& node : nodes_) node.moved = node.x + dt * dt * node.inverse_mass * node.f;
  move_vertices();
  moved_by_ = 0;
  for (const Vertex& vertex : vertices_) moved_by_ = std::max(moved_by_, (vertex.moved - vertex.seen).norm());
  return Found::here;
}

void FacePress::share_out(const ShapePose& pose) noexcept {
  borne_.setZero();
  normal_ = pose.normal();
  for (const Vertex& vertex : vertices_)
    if (vertex.n == 0) borne_ += pose.axes * vertex.f;  // by scenery
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
    const Node& node = nodes_[n];
    if (node.f.isZero()) continue;
    const Vec3 f = pose.axes * node.f;
    borne_ += f;
    forces_.push_back({node.cell, f});
    bears_.push_back(n);
    ++begins_[node.body + 1];
  }
  std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
  double sum = 0;
  Vec3 centre = Vec3::Zero();
  for (const std::uint32_t s : near_) {
    const Sample& sample = samples_[s];
    if (sample.p <= 0) continue;
    centre += sample.p * sample.x;
    area_ += sample.k / faces_[sample.face].k;
    across_ += 0.5 * sample.part * sample.k * sample.c * sample.o.head<2>().squaredNorm();
    sum += sample.p;
    overlap_ += sample.p * sample.p / (sample.k * sample.c);
  }
  overlap_ /= sum;
  centre_ = pose.tip + pose.axes * (centre / sum);
}

void FacePress::spread(const Vec3& force) noexcept {
  const Vec3 missing = force - borne_;
  const double pressed = borne_.dot(normal_);
  if (!(pressed < 0)) return;
  for (NodalForce& nodal : forces_) nodal.force += nodal.force.dot(normal_) / pressed * missing;
}

bool FacePress::press(const ShapePose& pose, const PressBy& by, double dt) noexcept {
  if (faces_.empty() || !by.presses()) {
    release();
    return false;
  }
  drop_forces();
  attitude_ = pose.attitude;
  auto found = Found::elsewhere;
  for (int start = 0; start < most_starts && found == Found::elsewhere; ++start) {
    read_nodes(pose);
    collect();
    for (int n = 0; n < sweeps; ++n)
      if (found = sweep(by, dt, n == 0); found != Found::here) break;
  }
  if (found == Found::nothing || samples_.empty()) {
    release();
    return false;
  }
  touching_ = true;
  share_out(pose);
  return true;
}

}  // namespace palpate::physics
