#include "physics_node/contact/blade_links.h"

#include <algorithm>
#include <cmath>

namespace palpate::physics {
namespace {

// In spacings.
constexpr double around_reach = 5;   // of what is listed now and then
constexpr double gather_around = 3;  // and of what is listed each frame, ahead of the edge and behind it
constexpr double across_reach = 2;   // Why: the longest element of a lattice is 1.5 spacings
constexpr double across_margin =
    0.3;  // Why: a step moves tissue by much less than that, a frame of 1 ms does, too
constexpr double settled_ahead = 1;  // farther ahead of the edge sides may change yet
constexpr double look_again_after = 1;
constexpr double tiny = 1e-6;
constexpr double look_again_s = 0.020;  // Why: tissue may come by itself

}  // namespace

BladeLinks::BladeLinks(const BodyModel& body, double length)
    : cells_(body), length_(length), h_(cells_.spacing()), response_(cells_.n_body_nodes()) {
  around_.reserve(cells_.all().size());
  number_.assign(cells_.capacity(), -1);
  side_.assign(number_.size(), 0);
  nodes_.reserve(most_nodes);
  links_.reserve(most_links);
  if (cells_.wall() > 0) wall_pieces_.reserve(most_nodes);
}

void BladeLinks::look_around(const BladeFrame& frame, const EdgePlace& edge) noexcept {
  const double reach = around_reach * h_;
  const auto is_near = [&](Index cell) {
    const Vec3 at = frame.coordinates(cells_.position(cell));
    const Vec3 edge_there(std::clamp(at.x(), 0.0, length_), std::clamp(at.y(), edge.last, edge.lag),
                          edge.slot);
    return (at - edge_there).squaredNorm() <= reach * reach;
  };
  for (const Index cell : around_)
    if (!is_near(cell)) side_[static_cast<std::size_t>(cell)] = 0;
  Eigen::AlignedBox3d box;
  for (const double q : {edge.last, edge.lag})
    for (const double p : {0.0, length_})
      box.extend(frame.tip + p * frame.along + q * frame.ahead + edge.slot * frame.side);
  box.min().array() -= reach, box.max().array() += reach;
  around_.clear();
  cells_.each_within(box, [&](Index cell) {
    if (is_near(cell)) around_.push_back(cell);
  });
}

void BladeLinks::reset() noexcept {
  for (const Node& node : nodes_) number_[static_cast<std::size_t>(node.cell)] = -1;
  std::ranges::fill(side_, std::int8_t{0});
  cells_.reset();
  around_.clear();
  when_ = -1e9;
  nodes_.clear();
  links_.clear();
}

void BladeLinks::settle_side(Node& node, const EdgePlace& edge) noexcept {
  std::int8_t& side = side_[static_cast<std::size_t>(node.cell)];
  if (!edge.bites || side == 0 || node.at.y() > edge.lag + settled_ahead * h_)
    side = node.at.z() >= edge.slot ? 1 : -1;
  node.side = side;
}

void BladeLinks::gather(const BladeFrame& frame, const EdgePlace& edge, double t) noexcept {
  const double s = edge.slot;
  const Vec3 tip = frame.tip + edge.lag * frame.ahead + s * frame.side, end = tip + length_ * frame.along;
  const double moved = std::max((tip - tip_).norm(), (end - end_).norm());
  if (moved > look_again_after * h_ || t - when_ >= look_again_s || t < when_) {
    look_around(frame, edge);
    tip_ = tip, end_ = end, when_ = t;
  }
  splits_ = cells_.splits();
  const double first = edge.last - gather_around * h_, last = edge.lag + gather_around * h_;
  for (const Node& node : nodes_) number_[static_cast<std::size_t>(node.cell)] = -1;
  nodes_.clear();
  links_.clear();
  for (const Index cell : around_) {
    const BladeCells::Nodes of = cells_.nodes(cell);
    const Vec3 rest = cells_.rest(cell), x = cells_.place_of(rest, of), at = frame.coordinates(x);
    if (at.x() < -across_reach * h_ || at.x() > length_ + across_reach * h_) continue;
    if (at.y() < first || at.y() > last || std::abs(at.z() - s) > across_reach * h_) continue;
    if (nodes_.size() == most_nodes) break;
    number_[static_cast<std::size_t>(cell)] = static_cast<std::int32_t>(nodes_.size());
    nodes_.push_back(
        {.cell = cell, .of = of, .toughness = cells_.toughness(cell), .rest = rest, .x = x, .at = at});
    settle_side(nodes_.back(), edge);
  }
  const double margin = across_margin * h_;
  for (std::uint32_t a = 0; a < nodes_.size(); ++a)
    cells_.each_joined(nodes_[a].cell, [&](Index other) {
      const std::int32_t b = number_[static_cast<std::size_t>(other)];
      if (b <= static_cast<std::int32_t>(a) || links_.size() == most_links) return;
      const Node& second = nodes_[static_cast<std::size_t>(b)];
      const auto [low, high] = std::minmax(nodes_[a].at.z(), second.at.z());
      if (nodes_[a].side == second.side && (low > s + margin || high < s - margin)) return;
      links_.push_back({.a = a, .b = static_cast<std::uint32_t>(b)});
    });
  join_islands(edge);
  cross(s);
  remember();
}

/// A cell before the edge that lies on one side, and all that it hangs together with on the other, would come off as a
/// crumb: it goes with them.
void BladeLinks::join_islands(const EdgePlace& edge) noexcept {
  if (!edge.bites || !cells_.are_elements()) return;
  for (Node& node : nodes_) {
    if (!cells_.is_element(node.cell)) continue;
    if (node.at.y() < edge.lag || node.at.y() > edge.lag + settled_ahead * h_) continue;
    bool alone = true, any = false;
    cells_.each_joined(node.cell, [&](Index other) {
      if (!cells_.is_element(other)) return;
      const std::int32_t n = number_[static_cast<std::size_t>(other)];
      any = true;
      alone = alone && n >= 0 && nodes_[static_cast<std::size_t>(n)].side != node.side;
    });
    if (!alone || !any) continue;
    node.side = static_cast<std::int8_t>(-node.side);
    side_[static_cast<std::size_t>(node.cell)] = node.side;
  }
}

void BladeLinks::remember() noexcept {
  for (Link& link : links_) link.before = link.now;
}

void BladeLinks::follow_splits() noexcept {
  if (cells_.splits() == splits_) return;
  splits_ = cells_.splits();
  for (Node& node : nodes_) node.of = cells_.nodes(node.cell);
}

void BladeLinks::begin_step() noexcept {
  follow_splits();
  for (Node& node : nodes_) {
    node.x = cells_.place_of(node.rest, node.of);
    node.v_before = cells_.velocity_of(node.of);
  }
}

void BladeLinks::update(const BladeFrame& frame, const EdgePlace& edge) noexcept {
  follow_splits();
  for (Node& node : nodes_) {
    const Vec3 x = cells_.place_of(node.rest, node.of);
    node.way = x - node.x;
    node.x = x;
    node.at = frame.coordinates(x);
    settle_side(node, edge);
    node.force.setZero();
    node.pull = 0;
  }
  cross(edge.slot);
}

void BladeLinks::cross(double s) noexcept {
  for (Link& link : links_) {
    const Vec3 &a = nodes_[link.a].at, &b = nodes_[link.b].at;
    Crossing& now = link.now;
    now.is = link.lives && nodes_[link.a].side != nodes_[link.b].side;
    if (!now.is) continue;
    const double apart = b.z() - a.z();
    now.t = std::abs(apart) > tiny * h_ ? std::clamp((s - a.z()) / apart, 0.0, 1.0) : 0.5;
    now.p = a.x() + now.t * (b.x() - a.x());
    now.q = a.y() + now.t * (b.y() - a.y());
    now.low = now.high = now.p;
  }
}

BladeLinks::Section BladeLinks::section_of(Index cell) const noexcept {
  Section section;
  const BladeCells::Nodes of = cells_.nodes(cell);
  std::array<Vec3, 8> at;
  for (std::size_t c = 0; c < of.n; ++c) at[c] = frame_.coordinates(cells_.corner(of.of[c]));
  for (const auto& [i, j] : cells_.edges()) {
    const double below = at[i].z() - plane_, above = at[j].z() - plane_;
    if ((below < 0) == (above < 0)) continue;
    const double p = at[i].x() + below / (below - above) * (at[j].x() - at[i].x());
    const bool first = section.high < section.low;
    section.low = first ? p : std::min(section.low, p);
    section.high = first ? p : std::max(section.high, p);
  }
  return section;
}

void BladeLinks::measure_sections(const BladeFrame& frame, double s) noexcept {
  frame_ = frame, plane_ = s;
  if (cells_.wall() > 0) return measure_wall();
  for (Link& link : links_) {
    if (!link.now.is) continue;
    for (const std::uint32_t end : {link.a, link.b}) {
      if (!cells_.has_section(nodes_[end].cell)) continue;
      const Section section = section_of(nodes_[end].cell);
      if (section.high < section.low) continue;
      link.now.low = std::min(link.now.low, section.low),
      link.now.high = std::max(link.now.high, section.high);
    }
  }
}

void BladeLinks::measure_wall() noexcept {
  wall_pieces_.clear();
  for (const Node& node : nodes_) {
    if (!cells_.is_element(node.cell)) continue;
    std::array<Vec3, 3> at, rest;
    for (std::size_t c = 0; c < 3; ++c) {
      at[c] = frame_.coordinates(cells_.corner(node.of.of[c]));
      rest[c] = cells_.rest_corner(node.of.of[c]);
    }
    WallPiece piece;
    std::array<Vec3, 2> now;
    std::size_t n = 0;
    for (std::size_t i = 0; i < 3 && n < 2; ++i) {
      const std::size_t j = (i + 1) % 3;
      const double below = at[i].z() - plane_, above = at[j].z() - plane_;
      if ((below < 0) == (above < 0)) continue;
      const double t = below / (below - above);
      now[n] = at[i] + t * (at[j] - at[i]), piece.rest[n] = rest[i] + t * (rest[j] - rest[i]);
      piece.p[n] = now[n].x(), piece.q[n] = now[n].y();
      ++n;
    }
    const double length = n == 2 ? (now[1] - now[0]).norm() : 0.0;
    if (length < tiny * h_) continue;
    piece.unstrained = (piece.rest[1] - piece.rest[0]).norm() / length;
    wall_pieces_.push_back(piece);
  }
}

bool BladeLinks::hangs_across(Index cell) const noexcept {
  if (!cells_.has_parted(cell)) return true;
  const std::int8_t side = side_[static_cast<std::size_t>(cell)];
  bool across = false;
  cells_.each_joined(cell, [&](Index other) {
    const std::int8_t there = side_[static_cast<std::size_t>(other)];
    across |= !cells_.is_skin(other) && there != 0 && there != side;
  });
  return across;
}

/// Over all that joined faces lead to, of what the plane has a section of and that is not far ahead or behind.
double BladeLinks::skin_along(const Link& link, double end) const noexcept {
  constexpr std::size_t most = 48;  // Why: a strip is half a spacing wide, and few tetrahedra lie beside it
  const bool down = end < link.now.p;
  double farthest = down ? -link.now.low : link.now.high;
  std::array<Index, most> seen;
  std::size_t n_seen = 0;
  const auto reach = [&](Index cell) {
    if (n_seen == most || !cells_.has_section(cell)) return;
    if (std::find(seen.begin(), seen.begin() + n_seen, cell) != seen.begin() + n_seen) return;
    const Vec3 at = frame_.coordinates(cells_.position(cell));
    if (std::abs(at.y() - link.now.q) > h_) return;
    const Section section = section_of(cell);
    if (section.high < section.low) return;
    if (n_seen >= 2 && !hangs_across(cell)) return;
    seen[n_seen++] = cell;
    farthest = std::max(farthest, down ? -section.low : section.high);
  };
  reach(nodes_[link.a].cell), reach(nodes_[link.b].cell);
  for (std::size_t n = 0; n < n_seen && farthest < (down ? -end : end); ++n)
    cells_.each_joined(seen[n], reach);
  return down ? -farthest : farthest;
}

void BladeLinks::give_way_to_pulls() noexcept {
  follow_splits();
  for (const Node& node : nodes_)
    if (node.pull > 0) response_.add(node.of, node.pull * Vec3::UnitX());
  for (Node& node : nodes_) node.gives = response_.of(node.of, cells_.inverse_mass()).x();
  for (const Node& node : nodes_) response_.clear(node.of);
}

void BladeLinks::give_way_to_forces() noexcept {
  follow_splits();
  for (const Node& node : nodes_)
    if (!node.force.isZero(0)) response_.add(node.of, node.force);
  for (Node& node : nodes_) node.gives_way = response_.of(node.of, cells_.inverse_mass());
  for (const Node& node : nodes_) response_.clear(node.of);
}

bool BladeLinks::sever(Link& link) noexcept {
  link.lives = link.now.is = false;
  bool parts = true;
  for (const std::uint32_t end : {link.a, link.b})
    if (cells_.is_skin(nodes_[end].cell)) cells_.pass_skin(nodes_[end].cell), parts = false;
  return parts;
}

}  // namespace palpate::physics
