#pragma once
// What joins cells of a body (blade_cells.h) across the plane of a blade, near its edge: elements of springs, or faces
// between tetrahedra.
//
// In the blade's own coordinates (p, q, r): p along the edge from the tip, q ahead of it, r out of the plane to the
// side. A link whose ends lie on both sides of r = s (r >= s counts as above) crosses the plane at
//
//   t = (s - r_a) / (r_b - r_a),   p = (1 - t) p_a + t p_b,   q alike
//
// so that whether an edge that lies at q(p) has passed it is a question of two numbers. Every link has one answer however
// the edge is divided and whichever way steps are: none slips between two strips or two steps.
//
// On which side a cell lies is settled once, before the edge comes to it: one that lies in the plane, and is moved to and fro,
// stays with the lip that it belongs to.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "physics_node/contact/blade_cells.h"

namespace palpate::physics {

/// Where the hand has a blade; along, ahead and side are unit and right-handed.
struct BladeFrame {
  Vec3 tip = Vec3::Zero();  // [m]
  Vec3 along = Vec3::UnitZ(), ahead = Vec3::UnitX(), side = Vec3::UnitY();
  Vec3 coordinates(const Vec3& x) const noexcept {  // p, q, r [m]
    const Vec3 d = x - tip;
    return {d.dot(along), d.dot(ahead), d.dot(side)};
  }
};

/// Where its edge is in the tissue, which is not where the hand has it.
struct EdgePlace {
  double lag = 0, last = 0;  // q of it, and of the part of it that is farthest behind [m]
  double slot = 0;           // r of its plane [m]
  bool bites = false;        // it is in the tissue, and the sides of what is near stay
};

class BladeLinks {
 public:
  static constexpr std::size_t most_nodes = 8192, most_links = 4096;

  struct Node {
    Index cell = 0;
    BladeCells::Nodes of{};         // of the body, that it has
    double toughness = 0;           // of its material [J/m^2]
    Vec3 rest = Vec3::Zero();       // [m]
    Vec3 x = Vec3::Zero();          // now [m]
    Vec3 way = Vec3::Zero();        // of the step that has just moved it [m]
    Vec3 v_before = Vec3::Zero();   // when it began [m/s]
    Vec3 at = Vec3::Zero();         // p, q, r
    Vec3 force = Vec3::Zero();      // of the blade in this step [N]
    std::int8_t side = 0;           // 1: above
    double pull = 0;                // sum of w k of what holds on to it [N/m]
    double gives = 0;               // by how much all these pulls move it: sum of pull / m [1/s^2]
    Vec3 gives_way = Vec3::Zero();  // and all forces [m/s^2]
  };
  /// Where an element crosses the plane, if it does.
  struct Crossing {
    bool is = false;
    double t = 0, p = 0, q = 0;
    double low = 0, high = 0;  // p of what the plane has of its two ends, where these have a volume
    /// Of what its ends have.
    Vec3 between(const Vec3& a, const Vec3& b) const noexcept { return (1 - t) * a + t * b; }
  };
  struct Link {
    std::uint32_t a = 0, b = 0;  // of nodes()
    bool lives = true;
    Crossing now{}, before{};  // before: when the last step ended
  };

  /// Of no body: nothing is near.
  BladeLinks() = default;
  /// @param body  of springs, or of tetrahedra that may be cut; outlives this  @param length  of the edge [m]
  BladeLinks(const BodyModel& body, double length);

  /// Before the steps of a frame: what may come to cross the plane in it. Cost: a pass over the nodes around; over all of the body,
  /// or where it is awake in parts over what lies about the edge, once the blade has gone a spacing, and every 20 ms.
  void gather(const BladeFrame& frame, const EdgePlace& edge, double t) noexcept;
  void begin_step() noexcept;
  /// After a step: where its nodes and crossings are now.
  void update(const BladeFrame& frame, const EdgePlace& edge) noexcept;
  /// Anew the crossings alone, of a plane at r = s.
  void cross(double s) noexcept;
  /// How far what crosses a plane at r = s reaches along the edge.
  void measure_sections(const BladeFrame& frame, double s) noexcept;
  /// The same of all that hangs together with a link along the edge, as far as `end`: p of the tissue's skin, or beyond `end`.
  double skin_along(const Link& link, double end) const noexcept;
  /// Of a surface what the plane has of its triangles, since measure_sections().
  struct WallPiece {
    std::array<double, 2> p{}, q{};  // of its ends [m]
    std::array<Vec3, 2> rest{};      // and where these are at rest [m]
    double unstrained = 1;           // its length at rest by that now
  };
  std::span<const WallPiece> wall_pieces() const noexcept { return wall_pieces_; }
  /// From the pulls or the forces of all nodes, by how much these give way.
  void give_way_to_pulls() noexcept;
  void give_way_to_forces() noexcept;
  /// The edge has gone through a link. @return is that something of the body that comes apart?
  bool sever(Link& link) noexcept;
  /// The crossings as they are become those of the step before.
  void remember() noexcept;
  void reset() noexcept;

  std::span<Node> nodes() noexcept { return nodes_; }
  std::span<Link> links() noexcept { return links_; }
  std::span<const Link> links() const noexcept { return links_; }
  std::span<const Node> nodes() const noexcept { return nodes_; }
  /// How far neighbours lie apart [m].
  double spacing() const noexcept { return h_; }
  const BladeCells& cells() const noexcept { return cells_; }
  bool has_sections() const noexcept { return cells_.have_volumes(); }
  /// Of a surface, how thick it is; else 0 [m].
  double wall() const noexcept { return cells_.wall(); }
  /// Do nodes part where it goes, and not springs between them?
  bool parts_nodes() const noexcept { return cells_.are_elements(); }

 private:
  void look_around(const BladeFrame& frame, const EdgePlace& edge) noexcept;
  /// Asks anew what nodes of the body its cells have, where one has split.
  void follow_splits() noexcept;
  /// What a plane at r = s has of a cell along the edge; none: high < low.
  struct Section {
    double low = 1, high = -1;
  };
  Section section_of(Index cell) const noexcept;
  /// Does a cell hang together with what lies on the other side of the plane, or has nothing parted it?
  bool hangs_across(Index cell) const noexcept;
  void join_islands(const EdgePlace& edge) noexcept;
  void measure_wall() noexcept;
  void settle_side(Node& node, const EdgePlace& edge) noexcept;

  BladeCells cells_;
  BladeFrame frame_;  // when sections were measured last, and s
  double plane_ = 0;
  double length_ = 0, h_ = 1;
  BladeCells::Response response_;
  std::vector<Index> around_;         // cells within a margin
  std::vector<std::int32_t> number_;  // of a node in nodes_, by cell; -1: none
  std::vector<std::int8_t> side_;     // of what is around, by cell; 0: not settled
  std::vector<Node> nodes_;
  std::vector<Link> links_;
  std::vector<WallPiece> wall_pieces_;
  Index splits_ = 0;                              // of the body, when nodes_ asked for theirs
  Vec3 tip_ = Vec3::Zero(), end_ = Vec3::Zero();  // where it looked around last [m]
  double when_ = -1e9;                            // [s]
};

}  // namespace palpate::physics
