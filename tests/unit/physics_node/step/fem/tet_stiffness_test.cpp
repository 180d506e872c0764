// The stiffness near rest is that of the forces, and with it a cantilever shows how linear tetrahedra lock and what cures it.

#include "physics_node/step/fem/tet_stiffness.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

#include "bench/problems/tet_beam.h"
#include "tests/unit/physics_node/step/fem/tet_bodies.h"

namespace palpate::physics {
namespace {

TEST(TetStiffness, IsTheSlopeOfTheForces) {
  for (const bool nodal : {false, true}) {
    const TetModel model = test::model_of({.cells = {4, 4, 2}, .nodal = nodal, .two_materials = true});
    const Eigen::SparseMatrix<double> stiffness = tet_stiffness(model);
    Tetrahedra<double> body(model);
    test::stir(body, 1e-9, 0);
    std::vector<Vec3> f(body.n_nodes());
    body.forces(f);
    Eigen::VectorXd u(stiffness.rows());
    for (Index n = 0; n < static_cast<Index>(body.n_nodes()); ++n) u.segment<3>(3 * n) = body.displacement(n);
    const Eigen::VectorXd expected = -stiffness * u;
    for (Index n = 0; n < static_cast<Index>(body.n_nodes()); ++n)
      EXPECT_LT((f[static_cast<std::size_t>(n)] - expected.segment<3>(3 * n)).norm(),
                1e-5 * expected.lpNorm<Eigen::Infinity>());
  }
}

struct BeamCase {
  int cells;
  double poisson_ratio;
  CubeSplit split;
  double plain, nodal;
};

/// Figures of an independent program, which summed the same in another way.
TEST(Cantilever, OfLinearTetrahedraLocksAndNodalPressureCuresIt) {
  using enum CubeSplit;
  for (const BeamCase& c : {BeamCase{2, 0.45, six, 0.309, 0.577}, BeamCase{4, 0.45, six, 0.609, 0.834},
                            BeamCase{2, 0.49, six, 0.115, 0.536}, BeamCase{4, 0.49, six, 0.299, 0.816},
                            BeamCase{2, 0.49, five, 0.584, 0.633}, BeamCase{4, 0.49, five, 0.831, 0.866}}) {
    const bench::TetCantilever how{.cells = c.cells, .poisson_ratio = c.poisson_ratio, .split = c.split};
    bench::TetCantilever plain = how;
    plain.nodal_pressure = false;
    const double p = bench::tet_beam_ratio(plain), n = bench::tet_beam_ratio(how);
    RecordProperty(fmt::format("beam_{}_{}", c.cells, c.poisson_ratio), fmt::format("{:.4f} {:.4f}", p, n));
    EXPECT_NEAR(p, c.plain, 0.001);
    EXPECT_NEAR(n, c.nodal, 0.001);
  }
}

/// Of CalculiX 2.20 with C3D10 on the same mesh; it loads nodes by the shape functions, and here masses weigh.
TEST(Cantilever, OfTetrahedraOfSecondOrderBendsAsThoseOfCalculix) {
  for (const BeamCase& c :
       {BeamCase{1, 0.45, CubeSplit::six, 0.9120, 0}, BeamCase{2, 0.3, CubeSplit::six, 0.9946, 0},
        BeamCase{2, 0.45, CubeSplit::six, 0.9801, 0}, BeamCase{2, 0.49, CubeSplit::six, 0.9640, 0}})
    EXPECT_NEAR(
        bench::tet_beam_ratio({.cells = c.cells, .poisson_ratio = c.poisson_ratio, .second_order = true}),
        c.plain, 0.003);
}

}  // namespace
}  // namespace palpate::physics
