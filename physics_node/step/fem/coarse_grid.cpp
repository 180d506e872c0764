#include "physics_node/step/fem/coarse_grid.h"

#include <algorithm>
#include <map>

namespace palpate::physics {
namespace {

/// Cells over the box of all places.
struct SortingBox {
  Vec3 low, cell;
  Eigen::Vector3i most;  // the last cell

  SortingBox(const std::vector<Vec3>& places, double edge) : low(places.front()) {
    Vec3 high = low;
    for (const Vec3& x : places) low = low.cwiseMin(x), high = high.cwiseMax(x);
    const Vec3 size = (high - low).cwiseMax(Vec3::Constant(1e-9 * edge));
    most = (size / edge).array().ceil().max(1).cast<int>() - 1;
    cell = size.cwiseQuotient(most.cast<double>() + Vec3::Ones());
  }
};

}  // namespace

CoarseGrid::CoarseGrid(const std::vector<Vec3>& places, const SparseRows& stiffness, double edge) {
  const SortingBox box(places, edge);
  std::map<std::array<int, 3>, int> number;  // of corners that some place sees
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t n = 0; n < places.size(); ++n) {
    const Vec3 x = (places[n] - box.low).cwiseQuotient(box.cell);
    const Eigen::Vector3i at = x.cast<int>().cwiseMin(box.most).cwiseMax(0);
    const Vec3 within = x - at.cast<double>();
    for (int c = 0; c < 8; ++c) {
      double weight = 1;
      std::array<int, 3> corner;
      for (int a = 0; a < 3; ++a) {
        const bool up = (c >> a & 1) != 0;
        weight *= up ? within[a] : 1 - within[a];
        corner[static_cast<std::size_t>(a)] = at[a] + (up ? 1 : 0);
      }
      if (weight < 1e-6) continue;
      const int of = number.try_emplace(corner, static_cast<int>(number.size())).first->second;
      for (int a = 0; a < 3; ++a) entries.emplace_back(3 * static_cast<int>(n) + a, 3 * of + a, weight);
    }
  }
  to_places_.resize(stiffness.rows(), 3 * static_cast<Eigen::Index>(number.size()));
  to_places_.setFromTriplets(entries.begin(), entries.end());
  to_grid_ = to_places_.transpose();
  const SparseRows moved = stiffness * to_places_;
  const Eigen::SparseMatrix<double> coarse = to_grid_ * moved;
  // A corner that a single place barely sees has next to no stiffness: what the scale of the rest adds is lost in rounding.
  Eigen::SparseMatrix<double> safe = coarse;
  const double more = 1e-12 * coarse.diagonal().maxCoeff();
  for (Eigen::Index i = 0; i < safe.rows(); ++i) safe.coeffRef(i, i) += more;
  stiffness_.compute(safe);
}

void CoarseGrid::correct(const Eigen::VectorXd& residual, Eigen::VectorXd& motion) const {
  const Eigen::VectorXd seen = to_grid_ * residual;
  motion += to_places_ * stiffness_.solve(seen);
}

}  // namespace palpate::physics
