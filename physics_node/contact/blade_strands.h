#pragma once
// The strands of connections that a sharp edge meets: each a slider that takes the strand's toughness times its area.
//
// A strand stands for a patch of tissue of area A, d = sqrt(A) wide and deep. The edge comes to it d before the
// strand and is through d behind it; s is how far it has come, from 0 to 2 d:
//
//   T(s) = Gc min(s, 2 d - s),   integral of T ds = Gc A
//
// Neighbours stand about d apart, so their T sum up to Gc times the length of the edge, and none begins or ends with
// a jump. The edge takes hold of a strand where it crosses the plane, and presses it with
//
//   F (ahead - (ahead . w) / (side . w) side),   F = k (b - x),   0 <= F <= (1 - c) T
//
// where F would be more, s goes on until it is not. w is along the strand, and the force at right angles to it: the
// edge slides along it, so that a blade that is inclined, or tissue that leans, is pushed aside, and what the hand
// pays is what is cut. b is where the blade is, x where the edge is in the strand's tissue, c what the strand pays by
// the energy that it holds (Griffith 1921). T is the mean of a step, so that the work is Gc A to rounding however
// fast the hand is. What has been cut of a strand no longer pulls. Its ends carry F by how near they are. Nothing
// holds the blade across: it goes between two surfaces.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "physics_node/connection/connection.h"
#include "physics_node/contact/blade_links.h"

namespace palpate::physics {

/// What a step of a blade did to tissue.
struct BladeOutcome {
  Vec3 force = Vec3::Zero();   // on it [N]
  Vec3 moment = Vec3::Zero();  // of that, about the tip [N m]
  double thrust = 0;           // of it ahead, and of what the tool holds tissue against by itself [N]
  double work = 0;             // of going on, which the hand pays [J]
  double released = 0;         // and that which tissue pays [J]
  double area = 0;             // opened [m^2]
  double power = 0;            // of the forces, with the velocities before the step [W]
};

class BladeStrands {
 public:
  /// @param connections  which outlive this @param length  of the edge [m]
  BladeStrands(const Connections& connections, double length);

  /// Before the steps of a frame: what the edge may come to in it. Cost: nothing; a pass over all strands once the
  /// blade has gone a few millimetres, and every 20 ms.
  /// @param lag  where the blade is, ahead of the hand [m] @param way  of the tip in the frame [m]
  void gather(const BladeFrame& frame, double lag, double way, double t) noexcept;
  bool is_near() const noexcept { return !near_.empty(); }

  void begin_step() noexcept;
  void clear_pushes() noexcept;
  /// After a step of dt: which of them the edge holds, and where it is in them.
  /// @param lag  of the blade, when the last step ended [m] @param stiffness  of the hand's spring [N/m]
  void meet(const BladeFrame& frame, double lag, double stiffness, double dt) noexcept;
  double lowest() const noexcept;              // where the edge is farthest behind in any, or 0 [m]
  double hold_ahead(double q) const noexcept;  // what all press with when the blade is there [N]
  double held() const noexcept;                // how stiffly they hold it [N/m]
  /// The blade is there: slides, and finds pushes(). @param borne  share of the force that strands bear, and the hand
  void slide(const BladeFrame& frame, double lag, double borne, BladeOutcome& done) noexcept;
  std::size_t n_pushes() const noexcept;
  void let_go() noexcept;

  /// Of the last step, on the strands of a connection.
  std::span<const StrandPush> pushes(std::size_t connection) const noexcept { return of_[connection].pushes; }

 private:
  struct Near {
    std::size_t connection = 0, strand = 0;
    bool bites = false;
    Connection::Ends v_before;  // when the step began [m/s]
    Vec3 x = Vec3::Zero();      // where it crosses the plane [m]
    double at = 0;              // of its way from node to foot
    double q = 0;               // where the edge is in it, in the blade's frame [m]
    double d = 0;               // side of its patch [m]
    double depth = 0;           // half of what the edge goes through [m]
    Vec3 push = Vec3::Zero();   // by how much F presses it, and which way
    double passed = 0;          // s / depth
    double k = 0;               // [N/m]
    double most = 0;            // largest T that the hand pays [N]
    double pays = 0;            // c
  };
  /// How far the edge goes on in a strand when the blade is at q, in depths, and the mean force of that.
  struct Slide {
    double on = 0;
    double force = 0;  // [N]
  };
  static Slide slide_of(const Near& near, double q) noexcept;
  void look_around(double reach) noexcept;
  bool follow(Near& near, const BladeFrame& frame, double lag) noexcept;
  void soften(double dt) noexcept;
  const Connection& connection_of(const Near& near) const noexcept { return *connections_[near.connection]; }
  const Strand& strand_of(const Near& near) const noexcept {
    return connection_of(near).strands()[near.strand];
  }

  enum class Side : std::uint8_t { unknown, before, behind };  // where it is seen from the edge
  struct OfConnection {
    std::vector<Side> side;     // by strand
    std::vector<double> depth;  // by strand, where its side is before [m]
    std::vector<std::array<std::uint32_t, 3>>
        feet;                  // by strand: its nodes of the second body, numbered without gaps
    std::vector<double> pull;  // by these: sum of w k of what holds on to one [N/m]
    std::vector<StrandPush> pushes;
  };
  const Connections& connections_;
  double length_;
  std::vector<OfConnection> of_;
  std::vector<Near> near_;
  Vec3 tip_ = Vec3::Zero(), end_ = Vec3::Zero();  // where it looked around last [m]
  double when_ = -1e9;                            // [s]
};

}  // namespace palpate::physics
