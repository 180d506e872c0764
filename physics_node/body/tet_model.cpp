#include "physics_node/body/tet_model.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace palpate::physics {
namespace {

const Vec3& corner_of(const TetMesh& mesh, const std::array<Index, 4>& corners, std::size_t a) noexcept {
  return mesh.nodes[static_cast<std::size_t>(corners[a])];
}

}  // namespace

TetNodes nodes_of(const TetMesh& mesh, std::size_t tet) noexcept {
  TetNodes nodes;
  for (std::size_t a = 0; a < 4; ++a) nodes.node[a] = mesh.tets[tet][a];
  if (mesh.middles.empty()) return nodes;
  nodes.n = most_tet_nodes;
  for (std::size_t e = 0; e < 6; ++e) nodes.node[4 + e] = mesh.middles[tet][e];
  return nodes;
}

std::vector<double> masses_of(const TetModel& model) {
  std::vector<double> masses(model.mesh.nodes.size());
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t) {
    const auto material = static_cast<std::size_t>(model.mesh.region[t]);
    const double mass = model.materials[material].density * signed_volume(model.mesh, model.mesh.tets[t]);
    const TetNodes nodes = nodes_of(model.mesh, t);
    for (std::size_t a = 0; a < nodes.n; ++a)
      masses[static_cast<std::size_t>(nodes.node[a])] += mass * (nodes.n == 4 ? 0.25
                                                                 : a < 4      ? corner_mass
                                                                              : middle_mass);
  }
  return masses;
}

std::array<Vec3, 3> slopes_of(const TetMesh& mesh, const std::array<Index, 4>& corners) noexcept {
  Eigen::Matrix3d edges;
  for (std::size_t k = 0; k < 3; ++k)
    edges.col(static_cast<Eigen::Index>(k)) = corner_of(mesh, corners, k + 1) - corner_of(mesh, corners, 0);
  const Eigen::Matrix3d inverse = edges.inverse();
  return {inverse.row(0), inverse.row(1), inverse.row(2)};
}

TetSharpness sharpness_of(const TetMesh& mesh, const std::array<Index, 4>& corners) noexcept {
  const auto slopes = slopes_of(mesh, corners);
  Vec3 first = Vec3::Zero();
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Vec3& b : slopes) sum += b * b.transpose(), first -= b;
  sum += first * first.transpose();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solved;
  solved.computeDirect(sum, Eigen::EigenvaluesOnly);
  return {.largest = solved.eigenvalues()[2], .trace = sum.trace()};
}

}  // namespace palpate::physics
