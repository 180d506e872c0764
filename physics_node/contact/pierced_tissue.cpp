#include "physics_node/contact/pierced_tissue.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics_node/body/build_lattice.h"

namespace palpate::physics {
namespace {

constexpr double most_strain = 0.3;  // Why: under a tip, in the mean of the ball; far from turning inside out
constexpr double fewest_spacings = 1.5,
                 most_spacings =
                     4;  // of r. Why: a ball has nodes wherever it lies; and is of the tissue at the tip
constexpr double in_a_tet =
    -1e-6;  // Why: the skin of a mesh is its faces, where rounding leaves a place outside
constexpr double most_boxes = 1 << 21;

const TetMesh& mesh_of(const Body& body) { return body.mesh->model.mesh; }

/// Most of what a tip presses with before it enters, by the modulus and its diameter: p Gc / E [m].
double gives_way_by(const Body& body) {
  double most = 0;
  for (const ElementLaw& law : body.laws)
    most = std::max(most, law.puncture_ratio * law.cut_toughness / law.modulus);
  return most;
}

/// Sorts what lies in boxes by these. @param each  calls its argument with (box, what), in a fixed order
template <class Each>
void sort_by_box(std::size_t n_boxes, const Each& each, std::vector<std::uint32_t>& from,
                 std::vector<Index>& all) {
  from.assign(n_boxes + 1, 0);
  each([&](std::size_t box, Index) { ++from[box + 1]; });
  for (std::size_t b = 0; b < n_boxes; ++b) from[b + 1] += from[b];
  all.resize(from[n_boxes]);
  std::vector<std::uint32_t> next(from.begin(), from.end() - 1);
  each([&](std::size_t box, Index what) { all[next[box]++] = what; });
}

}  // namespace

const char* not_to_be_pierced(const Body& body) noexcept {
  if (is_surface_of_springs(body)) return "a surface of springs; fill it with tetrahedra";
  if (!is_of_finite_elements(body))
    return "of springs; write model = \"fem\" there, or leave out rigid = true, which makes the needle a "
           "body";
  if (body.mesh && !body.mesh->model.mesh.middles.empty())
    return "of second order; write elements = \"nodal_pressure\" there";
  if (body.solid && !body.solid->failures.empty())
    return "of finite elements that break; leave break_ratio out of its materials";
  return nullptr;
}

PiercedTissue::PiercedTissue(const BodyModel& body, double diameter) : body_(&body) {
  const Body& of = body.body();
  spacing_ = of.mesh ? of.mesh->spacing : of.lattice.step.maxCoeff();
  poisson_ratio_ = of.mesh ? of.mesh->model.materials.front().poisson_ratio : of.solid->poisson_ratio;
  reach_ = std::clamp(std::sqrt(diameter * gives_way_by(of) / (std::numbers::pi * most_strain)),
                      fewest_spacings * spacing_, most_spacings * spacing_);
  scratch_.reserve(most_carriers);
  if (of.mesh)
    sort_mesh();
  else
    shift_ = lattice_corner(*of.cells, of.lattice);
}

Vec3i PiercedTissue::box_of(const Vec3& rest) const noexcept {
  const Vec3 in_boxes = (rest - low_) / box_;
  return in_boxes.cwiseMax(0.0)
      .cwiseMin((n_boxes_ - Vec3i::Ones()).cast<double>())
      .array()
      .floor()
      .cast<int>();
}

std::size_t PiercedTissue::number_of(const Vec3i& box) const noexcept {
  const auto at = [&](int a) { return static_cast<std::size_t>(box[a]); };
  return at(0) +
         static_cast<std::size_t>(n_boxes_.x()) * (at(1) + static_cast<std::size_t>(n_boxes_.y()) * at(2));
}

/// Each tetrahedron into all boxes that its own box meets.
void PiercedTissue::sort_mesh() {
  const TetMesh& mesh = mesh_of(body_->body());
  const Eigen::AlignedBox3d all = palpate::physics::box_of(mesh);
  low_ = all.min();
  box_ = std::max(2 * spacing_, std::cbrt(std::max(all.volume(), 0.0) / most_boxes));
  n_boxes_ = ((all.sizes() / box_).array().floor() + 1).cast<int>();
  const auto n = static_cast<std::size_t>(n_boxes_.cast<std::int64_t>().prod());
  const auto each_tet = [&](const auto& visit) {
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      Eigen::AlignedBox3d one;
      for (const Index node : mesh.tets[t]) one.extend(mesh.nodes[static_cast<std::size_t>(node)]);
      const Vec3 rounding = Vec3::Constant(1e-6 * spacing_);
      const Vec3i from = box_of(one.min() - rounding), to = box_of(one.max() + rounding);
      for (int k = from.z(); k <= to.z(); ++k)
        for (int j = from.y(); j <= to.y(); ++j)
          for (int i = from.x(); i <= to.x(); ++i) visit(number_of({i, j, k}), static_cast<Index>(t));
    }
  };
  sort_by_box(n, each_tet, tets_from_, tets_);
  const auto each_node = [&](const auto& visit) {
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
      visit(number_of(box_of(mesh.nodes[i])), static_cast<Index>(i));
  };
  sort_by_box(n, each_node, nodes_from_, nodes_);
}

std::optional<PiercedTissue::Place> PiercedTissue::find(const Vec3& rest, double beyond) const noexcept {
  if (!rest.allFinite()) return std::nullopt;
  return body_->body().mesh ? find_tet(rest) : find_cell(rest, beyond);
}

bool PiercedTissue::is_rigid(const Vec3& rest) const noexcept {
  const Body& body = body_->body();
  if (body.mesh || !rest.allFinite()) return false;
  const Cells& cells = *body.cells;
  const Vec3 in_cells = (rest - cells.corner).cwiseQuotient(cells.spacing);
  if ((in_cells.array() < 0).any() || (in_cells.array() >= cells.size.cast<double>().array()).any())
    return false;
  const Vec3i c = in_cells.array().floor().cast<int>();
  return cells.is_filled(c.x(), c.y(), c.z()) && !cells.is_deformable(c.x(), c.y(), c.z());
}

std::optional<PiercedTissue::Place> PiercedTissue::find_cell(const Vec3& rest, double beyond) const noexcept {
  const Body& body = body_->body();
  const Cells& cells = *body.cells;
  const Vec3 in_cells = (rest - cells.corner).cwiseQuotient(cells.spacing);
  if ((in_cells.array() < -2).any() || (in_cells.array() > cells.size.cast<double>().array() + 2).any())
    return std::nullopt;
  const Vec3i own = in_cells.array().floor().cast<int>();
  std::optional<Vec3i> best;
  double least = beyond * beyond;
  const int around = beyond > 0 ? 1 : 0;
  for (int k = -around; k <= around; ++k)
    for (int j = -around; j <= around; ++j)
      for (int i = -around; i <= around; ++i) {
        const Vec3i cell = own + Vec3i(i, j, k);
        if (cells.share_of(cell.x(), cell.y(), cell.z()) == 0) continue;
        const Vec3 away = in_cells - cell.cast<double>() - Vec3::Constant(0.5);
        const double outside = (away.cwiseAbs() - Vec3::Constant(0.5)).cwiseMax(0.0).squaredNorm();
        if (best ? outside >= least : outside > least) continue;
        best = cell, least = outside;
      }
  if (!best) return std::nullopt;
  return Place{rest, body.lattice.cell_of(*best - shift_)};
}

/// Barycentric coordinates.
Eigen::Vector4d PiercedTissue::shares(Index tet, const Vec3& rest) const noexcept {
  const TetMesh& mesh = mesh_of(body_->body());
  const auto& of = mesh.tets[static_cast<std::size_t>(tet)];
  const auto at = [&](std::size_t c) -> const Vec3& { return mesh.nodes[static_cast<std::size_t>(of[c])]; };
  Eigen::Matrix3d edges;
  edges << at(1) - at(0), at(2) - at(0), at(3) - at(0);
  const Vec3 b = edges.inverse() * (rest - at(0));
  return {1 - b.sum(), b.x(), b.y(), b.z()};
}

std::optional<PiercedTissue::Place> PiercedTissue::find_tet(const Vec3& rest) const noexcept {
  const std::size_t box = number_of(box_of(rest));
  double most = in_a_tet;
  Index best = -1;
  for (std::uint32_t n = tets_from_[box]; n < tets_from_[box + 1]; ++n)
    if (const double least = shares(tets_[n], rest).minCoeff(); least > most) most = least, best = tets_[n];
  if (best < 0) return std::nullopt;
  return Place{rest, best};
}

const ElementLaw& PiercedTissue::law(const Place& place) const noexcept {
  const Body& body = body_->body();
  const auto n = static_cast<std::size_t>(place.cell);
  if (body.mesh) return body.laws[static_cast<std::size_t>(mesh_of(body).region[n])];
  return body.solid->material_of.empty() ? body.laws.front() : body.laws[body.solid->material_of[n]];
}

template <class Visit>
void PiercedTissue::each_near(const Vec3& rest, const Visit& visit) const noexcept {
  const Body& body = body_->body();
  if (body.mesh) {
    const Vec3i from = box_of(rest - Vec3::Constant(reach_)), to = box_of(rest + Vec3::Constant(reach_));
    for (int k = from.z(); k <= to.z(); ++k)
      for (int j = from.y(); j <= to.y(); ++j)
        for (int i = from.x(); i <= to.x(); ++i) {
          const std::size_t box = number_of({i, j, k});
          for (std::uint32_t n = nodes_from_[box]; n < nodes_from_[box + 1]; ++n)
            visit(nodes_[n], mesh_of(body).nodes[static_cast<std::size_t>(nodes_[n])]);
        }
    return;
  }
  const Lattice& lattice = body.lattice;
  const Vec3 at = (rest - lattice.origin).cwiseQuotient(lattice.step),
             reach = Vec3::Constant(reach_).cwiseQuotient(lattice.step);
  const Vec3 most = lattice.size.cast<double>();
  const Vec3i from = (at - reach).cwiseMax(Vec3::Zero()).cwiseMin(most).array().ceil().cast<int>(),
              to = (at + reach).cwiseMax(Vec3::Zero()).cwiseMin(most).array().floor().cast<int>();
  for (int k = from.z(); k <= to.z(); ++k)
    for (int j = from.y(); j <= to.y(); ++j)
      for (int i = from.x(); i <= to.x(); ++i) {
        const Vec3i grid(i, j, k);
        const Index node = lattice.mass_at(grid);
        if (node >= 0) visit(node, lattice.origin + lattice.step.cwiseProduct(grid.cast<double>()));
      }
}

/// A node that a cut has split is carried by its copies as they have its cells.
void PiercedTissue::gather(const Vec3& rest, Carriers& by) const noexcept {
  const Body& body = body_->body();
  by.clear();
  double sum = 0;
  const auto add = [&](Index node, double weight) {
    if (by.size() == by.capacity()) return;
    by.push_back({node, weight});
    sum += weight;
  };
  const auto add_parts = [&](const auto& net, Index node, double near) {
    const double share = near / 8;
    net.each_around(node, [&](Index cell, std::size_t corner) { add(net.corners(cell)[corner], share); });
  };
  each_near(rest, [&](Index node, const Vec3& at) {
    const double near = 1 - (rest - at).squaredNorm() / (reach_ * reach_);
    if (!(near > 0)) return;
    const double weight = near * near * node_mass(body, node);
    if (body.mesh && body.mesh->net && body.mesh->net->has_split(node))
      add_parts(*body.mesh->net, node, weight);
    else if (const CellNet* net = body.cell_net(); net != nullptr && net->has_split(node))
      add_parts(*net, node, weight);
    else
      add(node, weight);
  });
  if (sum > 0)
    for (Carrier& one : by) one.weight /= sum;
}

Index PiercedTissue::copies() const noexcept {
  const Body& body = body_->body();
  if (body.mesh) return body.mesh->net ? body.mesh->net->n_copies() : 0;
  return body.cell_net() != nullptr ? body.cell_net()->n_copies() : 0;
}

Vec3 PiercedTissue::displacement(const Carriers& by) const noexcept {
  Vec3 sum = Vec3::Zero();
  for (const Carrier& one : by) sum += one.weight * body_->displacement(one.node);
  return sum;
}

Vec3 PiercedTissue::velocity(const Carriers& by) const noexcept {
  Vec3 sum = Vec3::Zero();
  for (const Carrier& one : by) sum += one.weight * body_->velocity(one.node);
  return sum;
}

/// By central differences over a tenth of r: w is smooth, and the error of these is below a hundredth of the strain.
Eigen::Matrix3d PiercedTissue::gradient(const Vec3& rest) noexcept {
  const double h = 0.1 * reach_;
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  for (int a = 0; a < 3; ++a)
    for (const double side : {-1.0, 1.0}) {
      gather(rest + side * h * Vec3::Unit(a), scratch_);
      F.col(a) += side / (2 * h) * displacement(scratch_);
    }
  return F;
}

Eigen::Matrix3d PiercedTissue::to_rest(const Vec3& rest) noexcept {
  constexpr double folded = 0.05, most_stretch = 10;
  const Eigen::Matrix3d F = gradient(rest);
  if (!(F.determinant() > folded)) return Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d inverse = F.inverse();
  return inverse.norm() < most_stretch ? inverse : Eigen::Matrix3d::Identity();
}

}  // namespace palpate::physics
