#include "bench/problems/tet_beam.h"

#include <Eigen/SparseCholesky>
#include <vector>

#include "bench/problems/hex_beam.h"
#include "physics_node/step/fem/tet_stiffness.h"

namespace palpate::bench {
namespace {

/// The part of the matrix that is of nodes which may move.
Eigen::SparseMatrix<double> of_free(const Eigen::SparseMatrix<double>& all, const std::vector<int>& number,
                                    int n) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < all.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(all, column); entry; ++entry) {
      const int i = number[static_cast<std::size_t>(entry.row())],
                j = number[static_cast<std::size_t>(column)];
      if (i >= 0 && j >= 0) entries.emplace_back(i, j, entry.value());
    }
  Eigen::SparseMatrix<double> free(n, n);
  free.setFromTriplets(entries.begin(), entries.end());
  return free;
}

}  // namespace

double tet_beam_ratio(const TetCantilever& how) {
  const double edge = HexBeam::height / how.cells;
  physics::TetModel model;
  model.mesh = physics::make_tet_box({.cells = {8 * how.cells, how.cells, how.cells},
                                      .edge = edge,
                                      .split = how.split,
                                      .jitter = how.jitter});
  model.materials = {{.modulus = HexBeam::modulus,
                      .poisson_ratio = how.poisson_ratio,
                      .density = HexBeam::density,
                      .nodal_pressure = how.nodal_pressure}};
  if (how.second_order) physics::add_middles(model.mesh);
  const auto& nodes = model.mesh.nodes;
  std::vector<int> number(3 * nodes.size(), -1);
  int n = 0;
  for (std::size_t i = 0; i < number.size(); ++i)
    if (nodes[i / 3].x() > 0.1 * edge) number[i] = n++;
  const auto masses = physics::masses_of(model);
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(n);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (number[3 * i + 2] >= 0) weight[number[3 * i + 2]] = -masses[i] * HexBeam::gravity;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(
      of_free(physics::tet_stiffness(model), number, n));
  const Eigen::VectorXd u = solver.solve(weight);
  double sunk = 0;
  int at_tip = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].x() > HexBeam::length - 0.1 * edge) sunk -= u[number[3 * i + 2]], ++at_tip;
  return sunk / at_tip / HexBeam({.cells = 2, .poisson_ratio = how.poisson_ratio}).calculix();
}

}  // namespace palpate::bench
