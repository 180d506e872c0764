#include "physics_node/step/surface_mesh/surface_spectrum.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "physics_node/step/largest_eigenvalue.h"
#include "physics_node/step/surface_mesh/surface_springs.h"

namespace palpate::physics {
namespace {

/// M^-1/2 K M^-1/2 at rest, held nodes left out:
///   K = sum of k u u^T of springs  -  p_0 H  +  K_c / V_0 g g^T
/// g = dV/dx, a third of the area vectors around each node; H = d2V/dx2: of a triangle (x_b, x_c moved by
/// d_b, d_c) node a gets (d_b x x_c + x_b x d_c) / 6. K_c is the modulus of what the surface is filled with.
class ScaledSurface {
 public:
  ScaledSurface(const SpringSurface& surface, const std::vector<double>& inverse_mass, bool is_filled)
      : surface_(surface), is_filled_(is_filled), d_(inverse_mass.size()), f_(inverse_mass.size()) {
    for (const double w : inverse_mass) root_.push_back(std::sqrt(w));
    slope_.assign(inverse_mass.size(), Vec3::Zero());
    for (const MeshTriangle& t : surface.mesh.triangles) {
      const Vec3 area = 0.5 * (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0]));
      for (const Index node : t) slope_[static_cast<std::size_t>(node)] += area / 3;
    }
  }
  Eigen::Index size() const noexcept { return 3 * static_cast<Eigen::Index>(root_.size()); }

  void apply(const Eigen::VectorXd& x, Eigen::VectorXd& y) noexcept {
    for (std::size_t n = 0; n < root_.size(); ++n)
      d_[n] = root_[n] * x.segment<3>(3 * static_cast<Eigen::Index>(n)), f_[n].setZero();
    for (const SurfaceSpring& spring : surface_.springs) {
      const auto [a, b] = spring.node;
      const Vec3 u = (at(b) - at(a)) / spring.length;
      const Vec3 pull = spring.k * u.dot(moved(a) - moved(b)) * u;
      force(a) += pull, force(b) -= pull;
    }
    if (is_filled_) fill();
    for (std::size_t n = 0; n < root_.size(); ++n)
      y.segment<3>(3 * static_cast<Eigen::Index>(n)) = root_[n] * f_[n];
  }

 private:
  Vec3 at(Index node) const { return surface_.mesh.nodes[static_cast<std::size_t>(node)]; }
  const Vec3& moved(Index node) const { return d_[static_cast<std::size_t>(node)]; }
  Vec3& force(Index node) { return f_[static_cast<std::size_t>(node)]; }

  void fill() noexcept {
    const Vec3 middle = at(0);  // so that no digits are lost
    for (const MeshTriangle& t : surface_.mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const Index b = t[(k + 1) % 3], c = t[(k + 2) % 3];
        force(t[k]) -= surface_.membrane.pressure / 6 *
                       (moved(b).cross(at(c) - middle) + (at(b) - middle).cross(moved(c)));
      }
    double swollen = 0;
    for (std::size_t n = 0; n < root_.size(); ++n) swollen += slope_[n].dot(d_[n]);
    for (std::size_t n = 0; n < root_.size(); ++n)
      f_[n] += surface_.membrane.content_modulus / surface_.volume * swollen * slope_[n];
  }

  const SpringSurface& surface_;
  bool is_filled_;
  std::vector<double> root_;
  std::vector<Vec3> slope_, d_, f_;
};

double largest(const SpringSurface& surface, const std::vector<double>& inverse_mass, bool is_filled) {
  ScaledSurface operation(surface, inverse_mass, is_filled);
  return largest_eigenvalue(operation, operation.size());
}

}  // namespace

StiffestMode stiffest_mode_of_loose_triangles(const SpringSurface& surface) {
  const Membrane& membrane = surface.membrane;
  const auto at = [&](Index node) { return surface.mesh.nodes[static_cast<std::size_t>(node)]; };
  double most = 0;
  for (const MeshTriangle& t : surface.mesh.triangles) {
    // Both k = E t A / L^2 and m = rho t A / 3 go with t A, which cancels.
    Eigen::Matrix<double, 9, 9> K = Eigen::Matrix<double, 9, 9>::Zero();
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3;
      const Vec3 side = at(t[static_cast<std::size_t>(b)]) - at(t[static_cast<std::size_t>(a)]);
      const double length2 = side.squaredNorm();
      const Eigen::Matrix3d k = membrane.modulus / (length2 * length2) * side * side.transpose();
      K.block<3, 3>(3 * a, 3 * a) += k, K.block<3, 3>(3 * b, 3 * b) += k;
      K.block<3, 3>(3 * a, 3 * b) -= k, K.block<3, 3>(3 * b, 3 * a) -= k;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> solver(K, Eigen::EigenvaluesOnly);
    most = std::max(most, 3 / membrane.density * solver.eigenvalues()[8]);
  }
  double heaviest = 0;  // node of all, by its drag, which its copies share by their mass
  for (const double mass : surface.mass) heaviest = std::max(heaviest, membrane.drag / mass);
  return {most, membrane.beta * most + heaviest};
}

StiffestMode stiffest_mode_of_surface(const SpringSurface& surface, std::vector<double> inverse_mass) {
  inverse_mass.resize(surface.mesh.nodes.size());  // without room for copies: whole, as loaded
  SurfaceSprings<double> springs(surface, inverse_mass);
  const Membrane& membrane = surface.membrane;
  StiffestMode mode{springs.omega2(), springs.gamma()};
  if (mode.omega2 <= 0) return mode;  // nothing of it moves
  const double found = largest(surface, inverse_mass, is_filled(membrane));
  mode.omega2 = std::min(mode.omega2, found);
  if (membrane.beta <= 0) return mode;
  const double of_springs = is_filled(membrane) ? largest(surface, inverse_mass, false) : found;
  mode.gamma =
      std::min(mode.gamma, membrane.beta * of_springs + membrane.drag * std::ranges::max(inverse_mass));
  return mode;
}

}  // namespace palpate::physics
