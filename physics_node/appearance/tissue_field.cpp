#include "physics_node/appearance/tissue_field.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "physics_node/material/lame.h"
#include "physics_node/material/st_venant_kirchhoff.h"
#include "physics_node/material/stable_neo_hookean.h"

namespace palpate::physics {
namespace {

using One = Scalar<double>;

/// Of the deviator.
double invariant(const Tensor<double>& a, double factor) {
  const double mean = trace(a) / 3;
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double d = a[i][j] - (i == j ? mean : 0);
      square += d * d;
    }
  return std::sqrt(factor * square);
}

double equivalent_strain(const Tensor<double>& H) {
  return invariant(StVenantKirchhoff<One>::green_strain(H), 2.0 / 3);
}

/// Cauchy's; nothing: it is inside out.
template <class Law>
Tensor<double> true_stress(const Law& law, const Tensor<double>& H) {
  const double J = 1 + StableNeoHookean<One>::volume_change(H, cofactor<One>(H));
  if (!(J > 0)) return {};
  const Tensor<double> P = law.stress(H), F = plus_identity<One>(H);
  Tensor<double> s{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) s[i][j] += P[i][k] * F[j][k] / J;
  return s;
}

double of_stress(ColourKind kind, const Tensor<double>& s) {
  return kind == ColourKind::stress ? invariant(s, 1.5) : std::max(0.0, -trace(s) / 3);
}

bool is_plain_mesh(const Body& body) {
  return body.mesh && !body.mesh->springs && body.mesh->model.mesh.middles.empty();
}

}  // namespace

std::unique_ptr<TissueField> TissueField::of(const BodyModel& moving, ColourKind kind) {
  const Body& body = moving.body();
  if (kind == ColourKind::awake) return std::unique_ptr<TissueField>(new TissueField(moving, kind));
  if (!is_of_physics(kind) || !(body.cells || is_plain_mesh(body))) return nullptr;
  if (kind != ColourKind::strain && (!is_of_finite_elements(body) || any_cells_yield(body))) return nullptr;
  return std::unique_ptr<TissueField>(new TissueField(moving, kind));
}

TissueField::TissueField(const BodyModel& moving, ColourKind kind) : moving_(moving), kind_(kind) {
  if (kind == ColourKind::awake) return;
  const Body& body = moving.body();
  if (body.cells) {
    cells_.emplace(body, moving.adjacency().of_all());
    return;
  }
  if (body.mesh->net) return;  // which knows what is at a node
  const auto& tets = body.mesh->model.mesh.tets;
  first_.assign(body.nodes().size() + 1, 0);
  for (const auto& corners : tets)
    for (const Index corner : corners) ++first_[static_cast<std::size_t>(corner) + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  tet_.resize(4 * tets.size());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (const Index corner : tets[t]) tet_[next[static_cast<std::size_t>(corner)]++] = static_cast<Index>(t);
}

TissueField::Around TissueField::around_cells(Index node) const noexcept {
  const Body& body = moving_.body();
  const CellNet* net = body.cell_net();
  const Vec3i corner = body.lattice.grid_of(body.origin(node)) + cells_->shift();
  Around sum;
  double n = 0;
  for (unsigned o = 0; o < 8; ++o) {
    const Vec3i cell = corner - Vec3i::Ones() + Vec3i(o & 1, o >> 1 & 1, o >> 2);
    if (body.cells->share_of(cell.x(), cell.y(), cell.z()) <= 0 ||
        cells_->left_of_any(cell) != CellsNow::whole)
      continue;
    std::array<Index, 8> at;
    bool whole = true;
    for (unsigned c = 0; c < 8; ++c) {
      at[c] = cells_->mass(cell + Vec3i(c & 1, c >> 1 & 1, c >> 2));
      whole = whole && at[c] >= 0;
    }
    if (!whole) continue;
    const Index lowest = at[0];
    if (net != nullptr && net->is_parted(lowest)) at = net->corners(lowest);
    if (at[7 - o] != node) continue;  // beyond a cut
    for (unsigned c = 0; c < 8; ++c) {
      const Vec3 u = moving_.displacement(at[c]);
      for (std::size_t j = 0; j < 3; ++j) {
        const auto axis = static_cast<Eigen::Index>(j);
        const double slope = ((c >> j & 1) != 0 ? 0.25 : -0.25) / body.cells->spacing[axis];
        for (std::size_t i = 0; i < 3; ++i) sum.H[i][j] += u[static_cast<Eigen::Index>(i)] * slope;
      }
    }
    if (body.solid)
      sum.modulus += body.solid->modulus *
                     static_cast<double>(body.solid->stiffness[static_cast<std::size_t>(lowest)]) /
                     static_cast<double>(body.cells->share_of(cell.x(), cell.y(), cell.z()));
    ++n;
  }
  if (n == 0) return sum;
  for (auto& row : sum.H)
    for (double& h : row) h /= n;
  sum.modulus /= n;
  sum.any = true;
  return sum;
}

TissueField::Around TissueField::around_tets(Index node) const noexcept {
  const MeshBody& mesh = *moving_.body().mesh;
  Around sum;
  double volume = 0;
  const auto add = [&](Index tet, const std::array<Index, 4>& corners) {
    const TetMesh& loaded = mesh.model.mesh;
    const auto t = static_cast<std::size_t>(tet);
    const std::array<Vec3, 3> slope = slopes_of(loaded, loaded.tets[t]);
    const double V = signed_volume(loaded, loaded.tets[t]);
    const Vec3 u0 = moving_.displacement(corners[0]);
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 u = moving_.displacement(corners[c + 1]) - u0;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          sum.H[i][j] += V * u[static_cast<Eigen::Index>(i)] * slope[c][static_cast<Eigen::Index>(j)];
    }
    sum.modulus += V * mesh.model.materials[static_cast<std::size_t>(loaded.region[t])].modulus;
    volume += V;
  };
  if (mesh.net) {
    mesh.net->each_corner(node, [&](Index tet, std::size_t) { add(tet, mesh.net->corners(tet)); });
  } else {
    for (std::size_t n = first_[static_cast<std::size_t>(node)];
         n < first_[static_cast<std::size_t>(node) + 1]; ++n)
      add(tet_[n], mesh.model.mesh.tets[static_cast<std::size_t>(tet_[n])]);
  }
  if (volume == 0) return sum;
  for (auto& row : sum.H)
    for (double& h : row) h /= volume;
  sum.modulus /= volume;
  sum.any = true;
  return sum;
}

double TissueField::at(Index node) const noexcept {
  if (kind_ == ColourKind::awake) return moving_.sleeps(node) ? 0 : 1;
  const Body& body = moving_.body();
  const Around here = cells_ ? around_cells(node) : around_tets(node);
  if (!here.any) return 0;
  if (kind_ == ColourKind::strain) return equivalent_strain(here.H);
  const double nu = body.solid ? body.solid->poisson_ratio : body.mesh->model.materials[0].poisson_ratio;
  const Lame lame = lame_of(here.modulus, nu);
  if (body.solid && body.solid->law == TissueLaw::green)
    return of_stress(kind_, true_stress(StVenantKirchhoff<One>{lame.mu, lame.lambda}, here.H));
  return of_stress(kind_, true_stress(StableNeoHookean<One>{lame.mu, lame.lambda}, here.H));
}

}  // namespace palpate::physics
