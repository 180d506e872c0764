#pragma once
// A block of tissue that is held at its bottom, of linear hexahedra, as a lattice of masses: 44 x 44 x 20 mm, 15 kPa, nu 0.4,
// with the surface at z = 0 and its first node at the origin.
//
//   M u'' + (a M + b K) u' + K u = f,    M lumped, a = 55 / s, b = 1e-4 s
//
// Rayleigh damping and steps of 125 us, semi-implicit. All blocks are alike, so that modes and compliances are found once.

#include <Eigen/Sparse>
#include <array>
#include <vector>

#include "haptic_node/tissue/tissue_surface.h"

namespace palpate::bench {

/// What the block is, in terms that a hand is told.
class BlockModel {
 public:
  static constexpr int side = 12, layers = 6;                                           // nodes
  static constexpr double distance = 4e-3;                                              // of nodes [m]
  static constexpr double youngs_modulus = 15e3, poissons_ratio = 0.4, density = 1000;  // [Pa], [kg/m^3]
  static constexpr double mass_damping = 55, stiffness_damping = 1e-4;                  // [1/s], [s]

  static const BlockModel& get();

  const Eigen::SparseMatrix<double>& stiffness() const noexcept { return K_; }
  const Eigen::VectorXd& mass() const noexcept { return M_; }  // of each coordinate
  const Eigen::MatrixXd& shapes() const noexcept { return shapes_; }
  const std::array<double, haptic::SurfaceModel::most_modes>& squares() const noexcept { return squares_; }
  /// First coordinate of node (i, j) of the surface.
  static int surface_coordinate(int i, int j) noexcept;
  /// b^T K^-1 b: how far the material point xi gives under a unit force there [m/N].
  haptic::Mat3 compliance(const haptic::SurfacePlace& xi) const;

  /// The patch around `xi`, with the lowest modes.
  haptic::SurfaceModel patch(const haptic::SurfacePlace& xi, std::uint32_t modes, double friction) const;

 private:
  BlockModel();
  void assemble();
  void find_modes(const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>& solver);
  void find_compliance(const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>& solver);
  void fill_tables();

  Eigen::SparseMatrix<double> K_;
  Eigen::VectorXd M_;
  Eigen::MatrixXd shapes_;
  std::array<double, haptic::SurfaceModel::most_modes> squares_{};
  Eigen::MatrixXd surface_;  // K^-1 between coordinates of the surface
  std::array<std::vector<std::array<double, 6>>, haptic::SurfaceModel::most_modes + 1> tables_;  // by modes
};

/// One that moves.
class TissueBlock {
 public:
  static constexpr double step = 125e-6;  // [s]

  /// A step under a force at a material point.
  void advance(const haptic::SurfacePlace& xi, const Vec3& force);

  struct Point {
    Vec3 at = Vec3::Zero(), v = Vec3::Zero(), normal = Vec3::Zero();
    std::array<Vec3, 2> tangents{};
  };
  Point point(const haptic::SurfacePlace& xi) const;
  double mode(std::uint32_t i) const;        // q_i
  double mode_speed(std::uint32_t i) const;  // w_i

 private:
  Eigen::VectorXd u_ = Eigen::VectorXd::Zero(BlockModel::get().mass().size());
  Eigen::VectorXd v_ = u_, pull_ = u_;
};

}  // namespace palpate::bench
