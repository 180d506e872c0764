#include "physics_node/collision/inside_others.h"

#include <algorithm>

#include "common/scene/scene.h"

namespace palpate::physics {
namespace {

// Why: a look at bodies in contact costs 0.15 to 0.3 us a mass (collide_a, c, d on a busy machine), so this is at most 60 us a frame, and
// 0.3 % of what a frame of these scenes takes.
constexpr Index masses_a_frame = 200;
constexpr std::size_t most_points = 65536;  // in one overlap; more would tell nothing new
constexpr double farthest_corner = 8;       // a volume whose first corner is so many L away is not looked at
constexpr Index any_piece = -1;             // of another body
// A place is looked for so many L nearer to the middle of its own body: what only lies on the other, as where two bodies are flush, is
// outside. And off the planes of a lattice, where faces between two volumes lie, by much less.
constexpr double inwards = 1e-5;
const Vec3 off_planes(3.1e-8, -1.7e-8, 2.3e-8);

Eigen::AlignedBox3d scenery_box(const Cells& cells) {
  Eigen::AlignedBox3d box;
  for (int k = 0; k < cells.size.z(); ++k)
    for (int j = 0; j < cells.size.y(); ++j)
      for (int i = 0; i < cells.size.x(); ++i) {
        const std::size_t c = cells.index(i, j, k);
        if (cells.filled[c] == 0 || cells.deformable[c] != 0) continue;
        const Vec3 centre = cells.centre_of(i, j, k);
        box.extend(centre - 0.5 * cells.spacing);
        box.extend(centre + 0.5 * cells.spacing);
      }
  return box;
}

std::size_t masses_of(const BodyModels& bodies) {
  std::size_t n = 0;
  for (const auto& body : bodies) n += static_cast<std::size_t>(body->body().n_nodes());
  return n;
}

}  // namespace

InsideOthers::InsideOthers(const BodyModels& bodies)
    : now_(bodies.size(), 0),
      most_(bodies.size(), 0),
      room_(std::min(most_points, masses_of(bodies))),
      grid_(room_),
      frames_between_(1 + static_cast<int>(masses_of(bodies) / masses_a_frame)) {
  point_.reserve(room_);
  inside_.reserve(room_);
  piece_.reserve(room_);
  for (const auto& moving : bodies) {
    const Body& body = moving->body();
    Other& other = bodies_.emplace_back(Other{moving.get(), FilledVolumes(*moving)});
    for (const Index node : body.nodes()) other.rest.push_back(body.rest_position(node));
    cell_ = std::max(cell_, body.spacing());
    if (!body.cells) continue;
    other.scenery = scenery_box(*body.cells);
    other.has_scenery = !other.scenery.isEmpty();
  }
}

void InsideOthers::find_box(Other& body) noexcept {
  body.box = body.scenery;
  const auto masses = body.moving->body().nodes();
  for (std::size_t n = 0; n < masses.size(); ++n)
    body.box.extend(body.rest[n] + body.moving->displacement(masses[n]));
}

/// Takes those masses of a body that lie in a box. @param apart  null: whatever piece they belong to
void InsideOthers::take_points(const Other& of, const Eigen::AlignedBox3d& box,
                               const Fragments* apart) noexcept {
  point_.clear(), piece_.clear();
  near_.setEmpty();
  if (box.isEmpty()) return;
  grid_.clear({cell_, cell_, cell_, cell_});
  const auto masses = of.moving->body().nodes();
  for (std::size_t n = 0; n < masses.size() && point_.size() < room_; ++n) {
    const Vec3 p = of.rest[n] + of.moving->displacement(masses[n]);
    if (of.moving->body().is_beyond(masses[n])) continue;
    if (!box.contains(p)) continue;  // nor does it where it is not finite
    const Vec3 looked_for = p + cell_ * (inwards * (of.box.center() - p).stableNormalized() + off_planes);
    grid_.insert(static_cast<std::uint32_t>(point_.size()), 0, looked_for);
    point_.push_back(looked_for);
    piece_.push_back(apart != nullptr ? apart->label(masses[n]) : 0);
    near_.extend(looked_for);
  }
  grid_.arrange();
  inside_.assign(point_.size(), 0);
}

/// The box round what it shares with the boxes of all others.
Eigen::AlignedBox3d InsideOthers::overlap_of(std::size_t body) const noexcept {
  Eigen::AlignedBox3d overlap;
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    if (b != body && bodies_[body].box.intersects(bodies_[b].box))
      overlap.extend(bodies_[body].box.intersection(bodies_[b].box));
  return overlap;
}

/// p = sum b_i x_i with sum b_i = 1 is inside where all b_i > 0, whichever way the corners go round.
void InsideOthers::mark_in_tetrahedron(const std::array<Vec3, 4>& x, Index piece) noexcept {
  Eigen::AlignedBox3d box(x[0].cwiseMin(x[1]).cwiseMin(x[2]).cwiseMin(x[3]),
                          x[0].cwiseMax(x[1]).cwiseMax(x[2]).cwiseMax(x[3]));
  if (!box.intersects(near_)) return;
  const Vec3 a = x[1] - x[0], b = x[2] - x[0], c = x[3] - x[0];
  const double volume = a.dot(b.cross(c));
  if (volume == 0) return;
  const Vec3 u = b.cross(c) / volume, v = c.cross(a) / volume, w = a.cross(b) / volume;
  grid_.visit_box(0, box.min(), box.max(), [&](std::uint32_t n, const Vec3&) {
    if (piece_[n] == piece) return;
    const Vec3 p = point_[n] - x[0];
    const double i = u.dot(p), j = v.dot(p), k = w.dot(p);
    if (i > 0 && j > 0 && k > 0 && i + j + k < 1) inside_[n] = 1;
  });
}

/// @param apart  of a body with itself: its own volumes hold nothing of their own fragment
void InsideOthers::mark_in_volumes(const Other& outer, const Fragments* apart) noexcept {
  const BodyModel& moving = *outer.moving;
  const auto nodes = moving.body().nodes();
  Eigen::AlignedBox3d reach = near_;
  const Vec3 margin = Vec3::Constant(
      std::max(farthest_corner * moving.body().spacing(), 2 * moving.body().longest_element()));
  reach.min() -= margin, reach.max() += margin;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (!reach.contains(outer.rest[n] + moving.displacement(nodes[n]))) continue;
    const Index piece = apart != nullptr ? apart->label(nodes[n]) : any_piece;
    outer.volumes.each(nodes[n], [&](const std::array<Vec3, 4>& x) { mark_in_tetrahedron(x, piece); });
  }
}

void InsideOthers::mark_in_scenery(const Other& outer) noexcept {
  const Cells& cells = *outer.moving->body().cells;
  for (std::size_t n = 0; n < point_.size(); ++n) {
    if (!outer.scenery.contains(point_[n])) continue;
    const Vec3i c = cells.cell_at(point_[n]);
    if (cells.is_filled(c.x(), c.y(), c.z()) && !cells.is_deformable(c.x(), c.y(), c.z())) inside_[n] = 1;
  }
}

Index InsideOthers::marked() const noexcept {
  return static_cast<Index>(std::count(inside_.begin(), inside_.end(), 1));
}

Index InsideOthers::between_pieces(std::size_t body, const Fragments& fragments) noexcept {
  if (fragments.count() < 2) return 0;
  find_box(bodies_[body]);
  take_points(bodies_[body], bodies_[body].box, &fragments);
  mark_in_volumes(bodies_[body], &fragments);
  return marked();
}

void InsideOthers::look() noexcept {
  for (Other& body : bodies_) find_box(body);
  for (std::size_t a = 0; a < bodies_.size(); ++a) {
    take_points(bodies_[a], overlap_of(a), nullptr);
    for (std::size_t b = 0; b < bodies_.size() && !point_.empty(); ++b) {
      if (b == a || !near_.intersects(bodies_[b].box)) continue;
      mark_in_volumes(bodies_[b], nullptr);
      if (bodies_[b].has_scenery) mark_in_scenery(bodies_[b]);
    }
    now_[a] = point_.empty() ? 0 : marked();
    most_[a] = std::max(most_[a], now_[a]);
  }
  frames_left_ = frames_between_;
}

void InsideOthers::look_now_and_then() noexcept {
  if (--frames_left_ <= 0) look();
}

void InsideOthers::restart() noexcept {
  std::fill(now_.begin(), now_.end(), 0);
  std::fill(most_.begin(), most_.end(), 0);
  frames_left_ = 0;
}

bool InsideOthers::any() const noexcept {
  return std::any_of(most_.begin(), most_.end(), [](Index n) { return n > 0; });
}

}  // namespace palpate::physics
