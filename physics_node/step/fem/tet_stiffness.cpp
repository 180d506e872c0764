#include "physics_node/step/fem/tet_stiffness.h"

#include <map>
#include <utility>
#include <vector>

#include "physics_node/material/lame.h"
#include "physics_node/step/fem/tet10_element.h"

namespace palpate::physics {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

void add_block(Triplets& entries, Index row, Index column, const Eigen::Matrix3d& block) {
  for (Eigen::Index i = 0; i < 3; ++i)
    for (Eigen::Index j = 0; j < 3; ++j)
      entries.emplace_back(3 * static_cast<int>(row) + static_cast<int>(i),
                           3 * static_cast<int>(column) + static_cast<int>(j), block(i, j));
}

std::array<Vec3, 4> all_slopes(const TetMesh& mesh, const std::array<Index, 4>& corners) {
  const auto b = slopes_of(mesh, corners);
  return {-(b[0] + b[1] + b[2]), b[0], b[1], b[2]};
}

/// Of one point of weight `volume`, whose slopes of shape functions are these.
void add_point(Triplets& entries, const TetNodes& nodes, const std::array<Vec3, most_tet_nodes>& slope,
               double volume, const Lame& lame) {
  for (std::size_t p = 0; p < nodes.n; ++p)
    for (std::size_t q = 0; q < nodes.n; ++q)
      add_block(entries, nodes.node[p], nodes.node[q],
                volume * (lame.lambda * slope[p] * slope[q].transpose() +
                          lame.mu * slope[q] * slope[p].transpose() +
                          lame.mu * slope[p].dot(slope[q]) * Eigen::Matrix3d::Identity()));
}

/// Slopes of the ten shape functions at a point, see tet10_element.h.
std::array<Vec3, most_tet_nodes> slopes_at(const std::array<Vec3, 4>& b, std::size_t point) {
  std::array<Vec3, most_tet_nodes> slope;
  slope.fill(Vec3::Zero());
  for (std::size_t a = 0; a < 4; ++a) {
    slope[a] -= b[a];
    for (std::size_t c = 0; c < 4; ++c)
      slope[tet10_between[a][c]] += 4 * (c == point ? tet10_near : tet10_far) * b[a];
  }
  return slope;
}

/// V_n G_n of each share, and what it weighs.
struct Swelling {
  Triplets slopes;  // by share
  std::vector<double> lambda, volume;
};

Swelling swelling_of(const TetModel& model) {
  Swelling swelling;
  std::map<std::pair<Index, int>, int> shares;  // node and material
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t) {
    const auto& corners = model.mesh.tets[t];
    const int material = model.mesh.region[t];
    const TetMaterial& of = model.materials[static_cast<std::size_t>(material)];
    const double quarter = signed_volume(model.mesh, corners) / 4;
    const auto b = all_slopes(model.mesh, corners);
    for (const Index node : corners) {
      const auto [at, fresh] = shares.try_emplace({node, material}, static_cast<int>(shares.size()));
      if (fresh) {
        swelling.lambda.push_back(lame_of(of.modulus, of.poisson_ratio).lambda);
        swelling.volume.push_back(0);
      }
      swelling.volume[static_cast<std::size_t>(at->second)] += quarter;
      for (std::size_t a = 0; a < 4; ++a)
        for (Eigen::Index i = 0; i < 3; ++i)
          swelling.slopes.emplace_back(at->second, 3 * static_cast<int>(corners[a]) + static_cast<int>(i),
                                       quarter * b[a][i]);
    }
  }
  return swelling;
}

}  // namespace

Eigen::SparseMatrix<double> tet_stiffness(const TetModel& model) {
  const bool nodal = has_nodal_pressure(model);
  Triplets entries;
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t) {
    const auto& corners = model.mesh.tets[t];
    const TetMaterial& material = model.materials[static_cast<std::size_t>(model.mesh.region[t])];
    Lame lame = lame_of(material.modulus, material.poisson_ratio);
    if (nodal) lame.lambda = 0;
    const double volume = signed_volume(model.mesh, corners);
    const auto b = all_slopes(model.mesh, corners);
    const TetNodes nodes = nodes_of(model.mesh, t);
    if (nodes.n == 4)
      add_point(entries, nodes, {b[0], b[1], b[2], b[3]}, volume, lame);
    else
      for (std::size_t point = 0; point < 4; ++point)
        add_point(entries, nodes, slopes_at(b, point), volume / 4, lame);
  }
  const auto n = 3 * static_cast<Eigen::Index>(model.mesh.nodes.size());
  Eigen::SparseMatrix<double> stiffness(n, n);
  stiffness.setFromTriplets(entries.begin(), entries.end());
  if (!nodal) return stiffness;
  const Swelling swelling = swelling_of(model);
  const auto shares = static_cast<Eigen::Index>(swelling.lambda.size());
  Eigen::SparseMatrix<double> slopes(shares, n);
  slopes.setFromTriplets(swelling.slopes.begin(), swelling.slopes.end());
  const Eigen::VectorXd weight =
      Eigen::Map<const Eigen::VectorXd>(swelling.lambda.data(), shares)
          .cwiseQuotient(Eigen::Map<const Eigen::VectorXd>(swelling.volume.data(), shares));
  const Eigen::SparseMatrix<double> weighted = weight.asDiagonal() * slopes;
  const Eigen::SparseMatrix<double> of_volume = slopes.transpose() * weighted;
  return stiffness + of_volume;
}

}  // namespace palpate::physics
