#pragma once
// A rigid shape without mass that a given force presses on the faces of bodies: how deep it goes, and what
// each node bears. Bodies that it spans bear it together: their faces are samples of one contact.
//
// Every face near the shape is divided into samples of an area A_s (at rest), which move with the corners of the face by their bilinear
// weights, and those with the nodes that carry them (bearers.h); w is the product. d_s is the signed distance of one
// from the shape, o_s its gradient. In a step of dt, when the elements have moved the nodes to x, the forces p_s o_s
// on the samples and the depth z of the shape solve
//
//   p_s = k A_s c_s max(0, -d_s) at x + dt^2 f / m and z,   f_i = sum_s w_si p_s o_s,   - sum_s p_s o_s . n = F
//
// which is the end of a step of backward Euler for contact alone: however stiff k = 100 E / h is, the step stays that of the elements. It is
// solved by sweeps, lumped: with K_i = sum_s k A_s c_s |w_si|,
//
//   p_s := max(0, p_s + (k A_s c_s (-d_s) - p_s) / (1 + dt^2 sum_i |w_si| K_i / m_i)),   z such that the sum is F in each
//
// The divisor is a bound of the row of the matrix that it stands for (Gershgorin), so no sweep goes too far; and what all sweeps together do
// is symmetric, so it gives no energy. c_s, from 0 to 1, lets go of faces that turn away from the shape: 2 (-o_s . N), N the normal of the face. So a wall that a
// cavity divides from the skin is not touched through it. The shape comes from outside, along -n, by the distance to the nearest sample:
// nothing is jumped. Source: sampled contact of faces as in Puso & Laursen 2004; projected Jacobi, Mandel 1984; the depth by balance: ours.

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "physics_node/boundary/boundary.h"
#include "physics_node/contact/press_by.h"
#include "physics_node/contact/rigid_shape.h"

namespace palpate::physics {

/// Where a shape is: its tip, and a frame around that, whose axes are the columns. It goes into tissue along the third, downwards.
struct ShapePose {
  Vec3 tip = Vec3::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
  /// Axes of the shape in that frame.
  Eigen::Matrix3d attitude = Eigen::Matrix3d::Identity();
  Vec3 normal() const { return axes.col(2); }
};
/// With this third axis; the others are any. @param attitude  of the shape in the world
ShapePose pose_along(const Vec3& tip, const Vec3& normal) noexcept;
ShapePose pose_along(const Vec3& tip, const Vec3& normal, const Eigen::Matrix3d& attitude) noexcept;

/// One that a shape presses.
struct PressedBody {
  const Boundary* surface = nullptr;
  const NodeMotion* moving = nullptr;
};

class FacePress {
 public:
  static constexpr std::size_t most_facets = 4096, most_samples = 65536;
  /// Why: three leave 1 % of what the first leaves, see docs/benchmarks.md.
  static constexpr int sweeps = 3;

  /// @param bodies  at least one; what they name outlives it
  FacePress(std::vector<PressedBody> bodies, const RigidShape& shape);
  FacePress(const Boundary& surface, const NodeMotion& moving, const RigidShape& shape)
      : FacePress({{&surface, &moving}}, shape) {}

  /// Takes the faces near the shape in place of those of before; allocates nothing. A place in `facets` for
  /// each body. What there is no room for is left out: first the rest of the last body.
  void take_candidates(std::span<const std::vector<std::uint32_t>> facets) noexcept;
  /// Lists of these what the shape may meet in the coming frame. Once a frame; allocates nothing.
  /// @param way  of the tip in the frame [m]
  void list(const ShapePose& pose, double way = 0) noexcept;
  /// Of one body.
  void list(const ShapePose& pose, const std::vector<std::uint32_t>& facets) noexcept {
    take_candidates({&facets, 1});
    list(pose);
  }

  /// The shape is pressed along -normal, without friction, in a step of dt whose elements have moved the nodes.
  /// @return false: it meets nothing, and forces() is empty
  bool press(const ShapePose& pose, const PressBy& by, double dt) noexcept;
  /// @param force  [N]
  bool press(const ShapePose& pose, double force, double dt) noexcept {
    return press(pose, PressBy{.force = force}, dt);
  }
  /// The pose's tip has moved: the depth below it is by so much another [m].
  void shift(double by) noexcept { z_ += by; }
  /// Adds to that what sums up to `force`, in the proportions of the pressure: friction, and what holds the shape where it is sideways.
  void spread(const Vec3& force) noexcept;
  /// Before a step: remembers where the nodes are that it lists, and how fast.
  void note_motion(bool verlet) noexcept;
  /// Of forces() with these velocities. [W]
  double power_before() const noexcept;
  /// Before spread(): what the shape lies on moves by in this step of dt, weighted by the pressure, if forces() add up to `force`:
  /// spreading F in its place moves it by dt^2 mobility() (F - force) more. Scenery stands [m].
  Vec3 way(double dt, const Vec3& force) const noexcept;
  /// Of what the shape lies on, to a force that is spread as the pressure is: sum s^2 / m [1/kg].
  double mobility() const noexcept;
  /// It is out of contact: the next one begins from outside.
  void release() noexcept;

  /// On nodes of a body; scenery bears the rest.
  std::span<const NodalForce> forces(std::size_t body = 0) const noexcept {
    return std::span(forces_).subspan(begins_[body], begins_[body + 1] - begins_[body]);
  }
  std::size_t n_forces() const noexcept { return forces_.size(); }  // of all bodies
  /// Of what presses along the pose's normal, the part that the nodes of a body bear [N].
  double pressed(std::size_t body) const noexcept;
  double depth() const noexcept { return z_; }    // of the tip below the pose's, along -normal [m]
  double area() const noexcept { return area_; }  // of the faces, at rest, that are in contact [m^2]
  /// Where it bears: the middle of the pressure, in the world [m].
  const Vec3& centre() const noexcept { return centre_; }
  /// On tissue and scenery by the last press, before spread() [N].
  const Vec3& borne() const noexcept { return borne_; }
  /// Of what presses, across the pose's normal: the mean of both directions [N/m].
  double across_stiffness() const noexcept { return across_; }
  struct WayOut {
    double distance =
        0;  // of the nearest point of these faces, of those that look at it; infinite where there is none [m]
    Vec3 direction = Vec3::Zero();  // from there, unit
  };
  /// From the faces near it to a point outside.
  WayOut way_out(const Vec3& from) const noexcept;
  /// How deep samples are in the shape, weighted by their pressure [m].
  double overlap() const noexcept { return overlap_; }
  /// From the pose's tip to the centroids of all faces that it may meet in a frame, as deep as it is [m].
  double reach() const noexcept;
  /// At what distance samples lie on a face of this area [m].
  double sample_spacing(double face_area) const noexcept;

 private:
  std::uint8_t a_side(double face_area) const noexcept;
  struct Facet {
    std::uint32_t body = 0, number = 0;
  };
  struct Node {
    const NodeMotion* moving = nullptr;
    std::uint32_t body = 0;
    Index cell = -1;
    double inverse_mass = 0;
    Vec3 x = Vec3::Zero(),
         f = Vec3::Zero();      // before contact, and by contact, in the frame of the pose [m], [N]
    Vec3 moved = Vec3::Zero();  // x + dt^2 f / m [m]
    Vec3 began = Vec3::Zero(), v = Vec3::Zero();  // see note_motion(), in the world [m], [m/s]
    double theta = 0;                             // dt^2 K / m
  };
  struct Bearing {
    std::uint32_t node = 0;
    double weight = 0;
  };
  /// A corner of faces.
  struct Vertex {
    std::uint32_t body = 0;
    std::uint32_t first = 0, n = 0;  // of bearings_; none: rigid scenery
    Vec3 offset = Vec3::Zero();      // from the mean of its nodes; of scenery its place, in the world [m]
    Vec3 apart = Vec3::Zero();       // the same in the frame of the pose [m]
    Vec3 x = Vec3::Zero(), f = Vec3::Zero(), moved = Vec3::Zero();  // as of nodes
    Vec3 seen = Vec3::Zero();  // `moved` when all samples were looked at last [m]
    double theta = 0;          // sum of |weight| theta
    double K = 0;              // [N/m]
  };
  struct Face {
    std::array<std::uint32_t, 4> vertex{};
    double k = 0;        // of an area [N/m^3]
    double area = 0;     // at rest [m^2]
    double reach = 0;    // from its middle to its corners [m]
    std::uint8_t n = 0;  // samples along a side
    bool triangle = false;
    Vec3 normal = Vec3::UnitZ();  // when samples were collected, in the frame of the pose
  };
  struct Sample {
    std::uint32_t face = 0;
    std::array<double, 4> w{};
    double k = 0;            // of its area [N/m]
    double clear = 0;        // distance from the shape when all were looked at last [m]
    double part = 1;         // 1 / (1 + sum w theta)
    double p = 0;            // of the last sweep [N]
    Vec3 x = Vec3::Zero();   // as of the last sweep [m]
    double next = 0, c = 0;  // of the last look: p, c
    Vec3 o = Vec3::UnitZ();
  };
  struct Balance {
    double force = 0, slope = 0;  // along -n [N], [N/m]
  };
  using Weights = std::array<double, 4>;
  RigidShape::Distance distance(const Vec3& p) const noexcept;
  const Weights& weights(const Face& face, std::uint32_t at) const noexcept;
  Vec3 at(const Face& face, const Weights& w) const noexcept;
  double around() const noexcept;
  const Boundary& surface(const Facet& facet) const noexcept { return *bodies_[facet.body].surface; }
  const NodeMotion& moving(const Facet& facet) const noexcept { return *bodies_[facet.body].moving; }
  double spacing(const Facet& facet) const noexcept { return moving(facet).body().spacing(); }
  Vec3 position(const Facet& facet, std::size_t corner) const noexcept {
    return surface(facet).position(facet.number, corner, moving(facet));
  }
  void drop_forces() noexcept;
  void find_vertices() noexcept;
  bool find_nodes() noexcept;
  void move_vertices() noexcept;
  void find_depth(const ShapePose& pose) noexcept;
  void read_nodes(const ShapePose& pose) noexcept;
  void collect() noexcept;
  double part(const Sample& sample) const noexcept;
  void keep_near(double within) noexcept;
  void look_at_all(double z) noexcept;
  Balance look(double z) noexcept;
  double nearest() const noexcept;
  enum class Found {
    here,
    elsewhere,
    nothing
  };  // elsewhere: beyond the samples that were collected, towards z_
  Found balance(const PressBy& by) noexcept;
  void lump(double dt, bool all) noexcept;
  void place_samples() noexcept;
  Found sweep(const PressBy& by, double dt, bool first) noexcept;
  void share_out(const ShapePose& pose) noexcept;

  std::vector<PressedBody> bodies_;
  std::vector<double> k_;  // of each, of an area [N/m^3]
  RigidShape shape_;
  bool turns_;  // a shape whose attitude makes a difference
  Eigen::Matrix3d attitude_ = Eigen::Matrix3d::Identity();
  double widest_ = 0;  // spacing of a body [m]
  double margin_ = 0;  // by which the depth may change before samples are collected anew [m]
  std::vector<Facet> candidates_;
  static constexpr int fewest_a_side = 2, most_a_side = 8;
  std::array<std::vector<Weights>, most_a_side + 1>
      weights_;  // of the samples of a face, by how many lie along a side
  std::vector<Face> faces_;
  std::vector<Facet> listed_;  // of each
  std::vector<Vertex> vertices_;
  std::vector<Bearing> bearings_;
  std::vector<Node> nodes_;
  struct Corner {
    std::uint32_t body = 0;
    std::int64_t corner = 0;  // Boundary::corner()
    std::uint32_t number = 0;
    auto operator<=>(const Corner&) const = default;
  };
  std::vector<Corner> corners_;  // of faces, by vertex
  struct Carrier {
    std::uint32_t body = 0;
    Index cell = -1;
    std::uint32_t bearing = 0;
    auto operator<=>(const Carrier&) const = default;
  };
  std::vector<Carrier> order_;  // of bearings, by node
  std::vector<Sample> samples_;
  // Of the samples: those that press or are no clearer than near_within_. No vertex has moved by more than moved_by_
  // since all were looked at, at the depth seen_z_. [m]
  std::vector<std::uint32_t> near_;
  double near_within_ = 0, seen_z_ = 0, moved_by_ = 0;
  std::vector<NodalForce> forces_;                      // by body
  std::vector<std::size_t> begins_;                     // of forces_, those of each body, and the end
  std::vector<std::uint32_t> bears_;                    // the node of each force
  Vec3 borne_ = Vec3::Zero(), normal_ = Vec3::UnitZ();  // of the last press, scenery's part included
  Vec3 centre_ = Vec3::Zero();
  double z_ = 0, collected_z_ = 0, area_ = 0, overlap_ = 0, across_ = 0;
  double way_ = 0;  // see list()
  bool touching_ = false;
};

}  // namespace palpate::physics
