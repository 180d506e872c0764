#include "physics_node/step/fem/tet_spectrum.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "physics_node/material/lame.h"
#include "physics_node/step/fem/tetrahedra.h"
#include "physics_node/step/largest_eigenvalue.h"

namespace palpate::physics {
namespace {

/// y = M^-1/2 K M^-1/2 x on the nodes that may move.
class ScaledTetStiffness {
 public:
  explicit ScaledTetStiffness(const TetModel& model)
      : body_(model), forces_(model.mesh.nodes.size(), Vec3::Zero()) {
    double smallest = HUGE_VAL;
    for (const auto& corners : model.mesh.tets)
      smallest = std::min(smallest, signed_volume(model.mesh, corners));
    size_ = 1e-6 * std::cbrt(smallest);
    for (Index n = 0; n < static_cast<Index>(forces_.size()); ++n)
      if (body_.inverse_mass(n) > 0) nodes_.push_back(n);
  }

  Eigen::Index size() const { return 3 * static_cast<Eigen::Index>(nodes_.size()); }

  void apply(const Eigen::VectorXd& x, Eigen::VectorXd& y) {
    const double one = size_ / x.cwiseAbs().maxCoeff();  // small, so that it is linear
    double most = 0;
    for (const Index node : nodes_) most = std::max(most, body_.inverse_mass(node));
    Eigen::Index n = 0;
    for (const Index node : nodes_) {
      const double root = std::sqrt(body_.inverse_mass(node) / most);
      body_.place(node, one * root * x.segment<3>(3 * n++), Vec3::Zero());
    }
    body_.forces(forces_);
    n = 0;
    for (const Index node : nodes_) {
      const double root = std::sqrt(body_.inverse_mass(node) * most);
      y.segment<3>(3 * n++) = -root / one * forces_[static_cast<std::size_t>(node)];
    }
  }

 private:
  Tetrahedra<double> body_;
  std::vector<Vec3> forces_;
  std::vector<Index> nodes_;
  double size_;
};

/// See tet_spectrum.h.
double second_order_factor() {
  Eigen::Matrix<double, 10, 10> sum = Eigen::Matrix<double, 10, 10>::Zero();
  for (std::size_t p = 0; p < 4; ++p) {
    Eigen::Matrix<double, 4, 10> to_corners = Eigen::Matrix<double, 4, 10>::Zero();
    for (std::size_t a = 0; a < 4; ++a) {
      const auto row = static_cast<Eigen::Index>(a);
      to_corners(row, row) = -1;
      for (std::size_t c = 0; c < 4; ++c)
        to_corners(row, static_cast<Eigen::Index>(tet10_between[a][c])) +=
            4 * (c == p ? tet10_near : tet10_far);
    }
    sum += to_corners.transpose() * to_corners / 4;
  }
  Eigen::Vector<double, 10> root;
  for (Eigen::Index a = 0; a < 10; ++a) root[a] = 1 / std::sqrt(a < 4 ? corner_mass : middle_mass);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 10, 10>> solved(
      root.asDiagonal() * sum * root.asDiagonal(), Eigen::EigenvaluesOnly);
  return solved.eigenvalues()[9];
}

}  // namespace

double fastest_element(const TetModel& model) {
  double fastest = 0;
  const double factor = model.mesh.middles.empty() ? 4 : second_order_factor();
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t) {
    const TetMaterial& material = model.materials[static_cast<std::size_t>(model.mesh.region[t])];
    const Lame lame = lame_of(material.modulus, material.poisson_ratio);
    const TetSharpness sharpness = sharpness_of(model.mesh, model.mesh.tets[t]);
    fastest = std::max(fastest, factor / material.density *
                                    (lame.lambda * sharpness.trace + 2 * lame.mu * sharpness.largest));
  }
  return fastest;
}

StiffestMode stiffest_mode_of_tetrahedra(const TetModel& model) {
  StiffestMode mode;
  ScaledTetStiffness operation(model);
  if (operation.size() == 0) return mode;
  mode.omega2 = std::min(fastest_element(model), largest_eigenvalue(operation, operation.size()));
  mode.gamma = model.beta * mode.omega2;
  return mode;
}

StiffestMode stiffest_mode_when_cut(const TetModel& model) {
  StiffestMode mode;
  mode.omega2 = fastest_element(model);
  mode.gamma = model.beta * mode.omega2;
  return mode;
}

}  // namespace palpate::physics
