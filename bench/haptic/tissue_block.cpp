#include "bench/haptic/tissue_block.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "haptic_node/tissue/spline_weights.h"

namespace palpate::bench {
namespace {

constexpr int side = BlockModel::side;
constexpr int free_layers = BlockModel::layers - 1;
constexpr int coordinates = 3 * side * side * free_layers;
constexpr int fine = haptic::SurfaceModel::finer * (side - 1) + 1;
constexpr int surface_size = 3 * side * side;

/// Node of layer k, from the surface down; below 0: held.
int first_coordinate(int i, int j, int k) { return k < free_layers ? 3 * (i + side * (j + side * k)) : -1; }

/// The stiffness of one cube, by 2 x 2 x 2 Gauss points; corners in the order of the bits x, y, z.
Eigen::Matrix<double, 24, 24> cube_stiffness() {
  const double E = BlockModel::youngs_modulus, nu = BlockModel::poissons_ratio, a = BlockModel::distance;
  Eigen::Matrix<double, 6, 6> D = Eigen::Matrix<double, 6, 6>::Zero();
  const double lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), shear = E / (2 * (1 + nu));
  D.topLeftCorner<3, 3>().setConstant(lambda);
  for (int i = 0; i < 3; ++i) D(i, i) += 2 * shear, D(i + 3, i + 3) = shear;
  Eigen::Matrix<double, 24, 24> k = Eigen::Matrix<double, 24, 24>::Zero();
  const double g = 1 / std::sqrt(3.0);
  for (int point = 0; point < 8; ++point) {
    const Vec3 at((point & 1) != 0 ? g : -g, (point & 2) != 0 ? g : -g, (point & 4) != 0 ? g : -g);
    Eigen::Matrix<double, 6, 24> B = Eigen::Matrix<double, 6, 24>::Zero();
    for (int n = 0; n < 8; ++n) {
      const Vec3 s((n & 1) != 0 ? 1 : -1, (n & 2) != 0 ? 1 : -1, (n & 4) != 0 ? 1 : -1);
      const Vec3 f = Vec3::Ones() + s.cwiseProduct(at);
      const Vec3 d = 0.25 / a * Vec3(s.x() * f.y() * f.z(), s.y() * f.x() * f.z(), s.z() * f.x() * f.y());
      const int c = 3 * n;
      B(0, c) = B(3, c + 1) = B(5, c + 2) = d.x();
      B(1, c + 1) = B(3, c) = B(4, c + 2) = d.y();
      B(2, c + 2) = B(4, c + 1) = B(5, c) = d.z();
    }
    k += a * a * a / 8 * B.transpose() * D * B;
  }
  return k;
}

/// Coefficients of the cubic spline through values at 2 .. fine - 3, straight at its ends; what lies beyond is never used.
Eigen::MatrixXd spline_through() {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(fine, fine), values = Eigen::MatrixXd::Zero(fine, fine);
  for (int i = 2; i <= fine - 3; ++i) {
    A(i, i - 1) = A(i, i + 1) = 1 / 6.0, A(i, i) = 4 / 6.0;
    values(i, i) = 1;
  }
  for (const auto& [row, at, next] : {std::array{1, 2, 3}, std::array{fine - 2, fine - 3, fine - 4}})
    A(row, row) = 1, A(row, at) = -2, A(row, next) = 1;
  A(0, 0) = A(fine - 1, fine - 1) = 1, A(0, 1) = A(fine - 1, fine - 2) = -1;
  return A.partialPivLu().solve(values);
}

}  // namespace

int BlockModel::surface_coordinate(int i, int j) noexcept { return first_coordinate(i, j, 0); }

const BlockModel& BlockModel::get() {
  static const BlockModel block;
  return block;
}

BlockModel::BlockModel() {
  assemble();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(K_);
  find_modes(solver);
  find_compliance(solver);
  fill_tables();
}

void BlockModel::assemble() {
  const Eigen::Matrix<double, 24, 24> cube = cube_stiffness();
  const double eighth = density * distance * distance * distance / 8;
  std::vector<Eigen::Triplet<double>> entries;
  M_ = Eigen::VectorXd::Zero(coordinates);
  for (int k = 0; k + 1 < layers; ++k)
    for (int j = 0; j + 1 < side; ++j)
      for (int i = 0; i + 1 < side; ++i) {
        std::array<int, 8> first{};
        for (int n = 0; n < 8; ++n)  // z of a corner counts up, layers count down
          first[static_cast<std::size_t>(n)] =
              first_coordinate(i + (n & 1), j + (n >> 1 & 1), k + 1 - (n >> 2 & 1));
        for (int a = 0; a < 24; ++a) {
          const int row = first[static_cast<std::size_t>(a / 3)];
          if (row < 0) continue;
          M_(row + a % 3) += eighth;
          for (int b = 0; b < 24; ++b) {
            const int column = first[static_cast<std::size_t>(b / 3)];
            if (column >= 0) entries.emplace_back(row + a % 3, column + b % 3, cube(a, b));
          }
        }
      }
  K_.resize(coordinates, coordinates);
  K_.setFromTriplets(entries.begin(), entries.end());
}

/// Subspace iteration: twice as many vectors as modes, from waves of the surface.
void BlockModel::find_modes(const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>& solver) {
  constexpr int wanted = haptic::SurfaceModel::most_modes, tried = 3 * wanted, rounds = 40;
  Eigen::MatrixXd X(coordinates, tried);
  for (int c = 0; c < tried; ++c)
    for (int d = 0; d < coordinates; ++d) {
      const int node = d / 3, wave = c / 3;
      X(d, c) = d % 3 == c % 3 ? std::cos(0.25 * (wave % 3) * (node % side)) *
                                     std::cos(0.25 * (wave / 3) * (node / side % side))
                               : 0.01 * std::cos(1.0 + d * (c + 1));
    }
  Eigen::VectorXd squares;
  for (int round = 0; round < rounds; ++round) {
    X = solver.solve(Eigen::MatrixXd(M_.asDiagonal() * X));
    const Eigen::MatrixXd KX = K_ * X, MX = M_.asDiagonal() * X;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> small(X.transpose() * KX,
                                                                          X.transpose() * MX);
    X = X * small.eigenvectors();
    squares = small.eigenvalues();
  }
  shapes_ = X.leftCols(wanted);
  for (int i = 0; i < wanted; ++i) squares_[static_cast<std::size_t>(i)] = squares(i);
}

void BlockModel::find_compliance(const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>& solver) {
  surface_.resize(surface_size, surface_size);  // the surface's coordinates are the first
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(coordinates);
  for (int c = 0; c < surface_size; ++c) {
    unit(c) = 1;
    surface_.col(c) = Eigen::VectorXd(solver.solve(unit)).head(surface_size);
    unit(c) = 0;
  }
}

haptic::Mat3 BlockModel::compliance(const haptic::SurfacePlace& xi) const {
  const haptic::SplineWeights a(xi.x(), side), b(xi.y(), side);
  Eigen::MatrixXd load = Eigen::MatrixXd::Zero(surface_size, 3);
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i)
      load.middleRows<3>(surface_coordinate(a.first + static_cast<int>(i), b.first + static_cast<int>(j))) =
          a.w[i] * b.w[j] * haptic::Mat3::Identity();
  return load.transpose() * surface_ * load;
}

/// b^T K^-1 b less sum psi psi^T / omega^2, at every half node, through which splines go.
void BlockModel::fill_tables() {
  const Eigen::MatrixXd spline = spline_through();
  std::array<std::array<Eigen::MatrixXd, 6>, haptic::SurfaceModel::most_modes + 1> values;
  for (auto& of_count : values) of_count.fill(Eigen::MatrixXd::Zero(fine, fine));
  for (int j = 2; j <= fine - 3; ++j)
    for (int i = 2; i <= fine - 3; ++i) {
      const haptic::SurfacePlace xi = haptic::SurfacePlace(i, j) / haptic::SurfaceModel::finer;
      haptic::Mat3 left = compliance(xi);
      const haptic::SplineWeights a(xi.x(), side), b(xi.y(), side);
      for (std::size_t modes = 0; modes < values.size(); ++modes) {
        if (modes > 0) {
          Vec3 psi = Vec3::Zero();
          for (std::size_t m = 0; m < 4; ++m)
            for (std::size_t n = 0; n < 4; ++n)
              psi += a.w[n] * b.w[m] *
                     shapes_.col(static_cast<Eigen::Index>(modes) - 1)
                         .segment<3>(surface_coordinate(a.first + static_cast<int>(n),
                                                        b.first + static_cast<int>(m)));
          left -= psi * psi.transpose() / squares_[modes - 1];
        }
        const std::array<double, 6> parts{left(0, 0), left(1, 1), left(2, 2),
                                          left(0, 1), left(0, 2), left(1, 2)};
        for (std::size_t k = 0; k < 6; ++k) values[modes][k](i, j) = parts[k];
      }
    }
  for (std::size_t modes = 0; modes < values.size(); ++modes) {
    tables_[modes].resize(fine * fine);
    for (std::size_t k = 0; k < 6; ++k) {
      const Eigen::MatrixXd c = spline * values[modes][k] * spline.transpose();
      for (int n = 0; n < fine * fine; ++n)
        tables_[modes][static_cast<std::size_t>(n)][k] = c(n % fine, n / fine);
    }
  }
}

haptic::SurfaceModel BlockModel::patch(const haptic::SurfacePlace& xi, std::uint32_t modes,
                                       double friction) const {
  using haptic::SurfaceModel;
  constexpr int width = SurfaceModel::most_side;
  SurfaceModel m;
  m.n_modes = modes;
  m.friction = friction;
  m.sides = {width, width};
  for (std::size_t axis = 0; axis < 2; ++axis)
    m.origin[axis] =
        std::clamp(static_cast<int>(std::lround(xi[static_cast<Eigen::Index>(axis)] - 0.5 * (width - 1))), 0,
                   side - width);
  for (std::uint32_t i = 0; i < modes; ++i)
    m.modes[i] = {squares_[i], mass_damping + stiffness_damping * squares_[i]};
  for (int j = 0; j < width; ++j)
    for (int i = 0; i < width; ++i) {
      SurfaceModel::Node& node = m.nodes[static_cast<std::size_t>(i + width * j)];
      const int a = m.origin[0] + i, b = m.origin[1] + j;
      node.rest = Vec3(distance * a, distance * b, 0);
      for (std::uint32_t k = 0; k < modes; ++k)
        node.shapes[k] = shapes_.col(k).segment<3>(surface_coordinate(a, b));
    }
  for (int j = 0; j < m.fine(1); ++j)
    for (int i = 0; i < m.fine(0); ++i)
      m.residual[static_cast<std::size_t>(i + m.fine(0) * j)] = tables_[modes][static_cast<std::size_t>(
          SurfaceModel::finer * m.origin[0] + i + fine * (SurfaceModel::finer * m.origin[1] + j))];
  return m;
}

void TissueBlock::advance(const haptic::SurfacePlace& xi, const Vec3& force) {
  const BlockModel& block = BlockModel::get();
  pull_ = u_ + BlockModel::stiffness_damping * v_;
  v_ -= step * BlockModel::mass_damping * v_ + step * (block.stiffness() * pull_).cwiseQuotient(block.mass());
  const haptic::SplineWeights a(xi.x(), side), b(xi.y(), side);
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i) {
      const int c =
          BlockModel::surface_coordinate(a.first + static_cast<int>(i), b.first + static_cast<int>(j));
      v_.segment<3>(c) += step * a.w[i] * b.w[j] / block.mass()(c) * force;
    }
  u_ += step * v_;
}

TissueBlock::Point TissueBlock::point(const haptic::SurfacePlace& xi) const {
  const haptic::SplineWeights a(xi.x(), side), b(xi.y(), side);
  Point p;
  for (Vec3& t : p.tangents) t.setZero();
  for (std::size_t j = 0; j < 4; ++j)
    for (std::size_t i = 0; i < 4; ++i) {
      const int m = a.first + static_cast<int>(i), n = b.first + static_cast<int>(j);
      const int c = BlockModel::surface_coordinate(m, n);
      const Vec3 lies = BlockModel::distance * Vec3(m, n, 0) + u_.segment<3>(c);
      p.at += a.w[i] * b.w[j] * lies;
      p.v += a.w[i] * b.w[j] * v_.segment<3>(c);
      p.tangents[0] += a.dw[i] * b.w[j] * lies;
      p.tangents[1] += a.w[i] * b.dw[j] * lies;
    }
  p.normal = p.tangents[0].cross(p.tangents[1]).normalized();
  return p;
}

double TissueBlock::mode(std::uint32_t i) const {
  const BlockModel& block = BlockModel::get();
  return block.shapes().col(i).dot(block.mass().cwiseProduct(u_));
}

double TissueBlock::mode_speed(std::uint32_t i) const {
  const BlockModel& block = BlockModel::get();
  return block.shapes().col(i).dot(block.mass().cwiseProduct(v_));
}

}  // namespace palpate::bench
