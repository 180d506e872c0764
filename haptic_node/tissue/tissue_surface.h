#pragma once
// The surface of tissue around a tip, reduced to what a hand can feel of it. A force F that presses its material point xi:
//
//   q_i'' + c_i q_i' + omega_i^2 q_i = psi_i(xi) . F,      S(xi) = X(xi) + r + sum psi_i(xi) q_i + R(xi) F
//
// X rest positions and psi_i shapes of modes (normalised by mass) at nodes, weighted by splines; R the static compliance less
// that of the modes, as coefficients of a spline on a grid twice as fine, since it ripples between nodes; r the rest.
// xi counts nodes of the whole surface, of which a patch is told. Tangents are those of the pressed surface:
//
//   t_a = dX/dxi_a + sum dpsi_i/dxi_a q_i + 1/2 dR/dxi_a F
//
// Why 1/2: it is the F for which t_a . F = 0 that neither gives nor takes when a tip slides without friction to where tissue
// gives more, since -F . t_a is the derivative of the energy e C^-1 e / 2 by xi_a.

#include <array>
#include <cstdint>

#include "haptic_node/tissue/friction_contact.h"

namespace palpate::haptic {

struct SurfaceMode {
  double stiffness = 0;  // omega^2 [1/s^2]
  double damping = 0;    // c [1/s]
};

struct SurfaceModel {
  static constexpr std::size_t most_modes = 9;
  static constexpr int least_side = 4, most_side = 8, finer = 2;
  static constexpr int most_nodes = most_side * most_side;
  static constexpr int most_fine = finer * (most_side - 1) + 1;

  struct Node {
    Vec3 rest = Vec3::Zero();               // X [m]
    std::array<Vec3, most_modes> shapes{};  // psi_i [1 / sqrt(kg)]
  };

  std::uint32_t n_modes = 0;
  std::array<SurfaceMode, most_modes> modes{};
  double friction = 0;                 // mu
  std::array<int, 2> origin{};         // node of the surface that is the patch's first
  std::array<int, 2> sides{4, 4};      // nodes along xi_0 and xi_1
  std::array<Node, most_nodes> nodes;  // [i + sides[0] j]
  /// xx, yy, zz, xy, xz, yz of R's coefficients [m/N], [i + fine(0) j]
  std::array<std::array<double, 6>, most_fine * most_fine> residual{};

  int fine(int axis) const noexcept { return finer * (sides[static_cast<std::size_t>(axis)] - 1) + 1; }
};

using SurfacePlace = Eigen::Vector2d;  // xi [nodes]

struct SurfaceState {
  std::array<double, SurfaceModel::most_modes> q{}, w{};  // [m sqrt(kg)], and per second
  SurfacePlace xi = SurfacePlace::Zero();
  Vec3 rest = Vec3::Zero();   // r [m]
  Vec3 force = Vec3::Zero();  // F, on the tissue [N]
};

/// A material point, as it lies with modes at q and rest r.
struct SurfacePoint {
  Vec3 modal = Vec3::Zero();  // X + r + sum psi q [m]
  Vec3 normal = Vec3::Zero();
  Mat3 residual = Mat3::Zero();  // R [m/N]
  std::array<Vec3, SurfaceModel::most_modes> psi{};
  std::array<Vec3, 2> tangents{};  // [m]

  /// How far in nodes it is to a point that lies `way` from here along the surface.
  SurfacePlace places_along(const Vec3& way) const noexcept;
};

/// @param q      modes, n_modes of them
/// @param force  that presses it [N]
SurfacePoint surface_point(const SurfaceModel& model, const std::array<double, SurfaceModel::most_modes>& q,
                           const Vec3& rest, const SurfacePlace& xi, const Vec3& force) noexcept;

/// The nearest place that the patch knows.
SurfacePlace on_patch(const SurfaceModel& model, const SurfacePlace& xi) noexcept;

/// What physics tells of one contact, and the state that the hand's sample number `stamp` brought it to.
struct SurfaceAnswer {
  std::uint64_t tick = 0;
  std::uint32_t tool = 0;
  std::uint64_t stamp = 0;
  SurfaceModel model;
  SurfaceState state;
};

/// All that is used is finite and in bounds, sides fit, and no residual compliance is below 0 in any direction.
bool is_sound(const SurfaceAnswer& answer, std::uint32_t tool) noexcept;

}  // namespace palpate::haptic
