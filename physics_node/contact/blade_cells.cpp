#include "physics_node/contact/blade_cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace palpate::physics {
namespace {

// Spacings of tetrahedra: the edge presses on all that lies within some of them ahead of it.
// Why: as wide as the longest join, or coarser parts of a mesh would have holes. And as Gc / E, by which tissue gives way
// before it is cut: pressed on more narrowly, elements turn inside out (at 20 kPa and 190 J/m^2 below 5 mm).
constexpr double of_giving_way = 0.6;
constexpr double most_joins = 4;  // or an edge would press on what is far beside it

/// Gc / E of the material in which it is largest [m].
double gives_way_by(const Body& body) {
  double most = 0;
  for (const ElementLaw& law : body.laws) most = std::max(most, law.cut_toughness / law.modulus);
  return most;
}

}  // namespace

BladeCells::BladeCells(const BodyModel& body) : body_(&body), h_(body.body().spacing()) {
  if (!body.body().mesh) return;
  net_ = body.body().mesh->net.get();
  skin_.assign(4 * static_cast<std::size_t>(net_->n_tets()), -1);
  for (Index tet = 0; tet < net_->n_tets(); ++tet)
    for (std::size_t f = 0; f < 4; ++f) {
      if (net_->beyond(tet, f) != TetNet::none) continue;
      skin_[4 * static_cast<std::size_t>(tet) + f] = static_cast<std::int32_t>(faces_.size());
      faces_.push_back({tet, f});
    }
  passed_.assign(faces_.size(), 0);
  numbers_.resize(static_cast<std::size_t>(net_->n_tets()) + faces_.size());
  std::iota(numbers_.begin(), numbers_.end(), 0);
  double longest2 = 0;
  for (const Index cell : numbers_)
    each_joined(
        cell, [&](Index other) { longest2 = std::max(longest2, (rest(cell) - rest(other)).squaredNorm()); });
  const double longest = std::sqrt(longest2);
  h_ = std::clamp(of_giving_way * gives_way_by(body.body()), longest, most_joins * longest);
}

double BladeCells::toughness(Index cell) const noexcept {
  const Body& body = body_->body();
  if (net_ == nullptr) return law_at(body, cell).cut_toughness;
  const Index tet = is_skin(cell) ? faces_[face_of(cell)].tet : cell;
  const int material = body.mesh->model.mesh.region[static_cast<std::size_t>(tet)];
  return body.laws[static_cast<std::size_t>(material)].cut_toughness;
}

BladeCells::Nodes BladeCells::nodes(Index cell) const noexcept {
  if (net_ == nullptr) return {{cell}, 1};
  if (!is_skin(cell)) return {net_->corners(cell), 4};
  const Skin& skin = faces_[face_of(cell)];
  const MeshTriangle face = net_->face(skin.tet, skin.face);
  return {{face[0], face[1], face[2], 0}, 3};
}

Vec3 BladeCells::rest(Index cell) const noexcept {
  return mean(cell, [this](Index node) { return body_->body().rest_position(node); });
}
Vec3 BladeCells::position(Index cell) const noexcept {
  return mean(cell, [this](Index node) { return body_->position(node); });
}
Vec3 BladeCells::velocity(Index cell) const noexcept {
  return mean(cell, [this](Index node) { return body_->velocity(node); });
}

}  // namespace palpate::physics
