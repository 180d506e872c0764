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

constexpr std::array<std::array<std::size_t, 2>, 12> hex_edges{
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

/// Gc / E of the material in which it is largest [m].
double gives_way_by(const Body& body) {
  double most = 0;
  for (const ElementLaw& law : body.laws) most = std::max(most, law.cut_toughness / law.modulus);
  return most;
}

}  // namespace

/// Outer faces are numbered in the order of the elements.
template <class Net>
void BladeCells::number_elements(const Net& net, std::span<const Index> elements, std::size_t n_faces) {
  numbers_.assign(elements.begin(), elements.end());
  skin_.assign(n_faces * static_cast<std::size_t>(first_skin_), -1);
  for (const Index element : elements)
    for (std::size_t f = 0; f < n_faces; ++f) {
      if (net.beyond(element, f) != Net::none) continue;
      skin_[n_faces * static_cast<std::size_t>(element) + f] = static_cast<std::int32_t>(faces_.size());
      numbers_.push_back(first_skin_ + static_cast<Index>(faces_.size()));
      faces_.push_back({element, f});
    }
  passed_.assign(faces_.size(), 0);
  rest_.assign(capacity(), Vec3::Zero());
  for (const Index cell : numbers_)
    rest_[static_cast<std::size_t>(cell)] =
        mean(nodes(cell), [this](Index node) { return body_->body().rest_position(node); });
}

BladeCells::BladeCells(const BodyModel& body)
    : body_(&body),
      tets_(body.body().mesh ? body.body().mesh->net.get() : nullptr),
      triangles_(body.body().mesh ? body.body().mesh->triangles.get() : nullptr),
      hexes_(body.body().cell_net()),
      h_(body.body().spacing()) {
  if (!are_elements()) return;
  const auto number_mesh = [this](const auto& net, std::size_t n_faces) {
    first_skin_ = net.n_elements();
    std::vector<Index> all(static_cast<std::size_t>(first_skin_));
    std::iota(all.begin(), all.end(), 0);
    number_elements(net, all, n_faces);
  };
  if (tets_ != nullptr) {
    number_mesh(*tets_, 4);
  } else if (triangles_ != nullptr) {
    number_mesh(*triangles_, 3);
  } else {
    first_skin_ = hexes_->n_loaded();
    number_elements(*hexes_, hexes_->cells(), CellNet::n_faces);
  }
  double longest2 = 0;
  for (const Index cell : numbers_)
    each_joined(
        cell, [&](Index other) { longest2 = std::max(longest2, (rest(cell) - rest(other)).squaredNorm()); });
  const double longest = std::sqrt(longest2);
  h_ = std::clamp(of_giving_way * gives_way_by(body.body()), longest, most_joins * longest);
}

double BladeCells::toughness(Index cell) const noexcept {
  const Body& body = body_->body();
  const Index element = is_skin(cell) ? faces_[face_of(cell)].element : cell;
  if (hexes_ != nullptr)
    return static_cast<double>(body.solid->cut_toughness[static_cast<std::size_t>(element)]);
  if (tets_ == nullptr) return law_at(body, cell).cut_toughness;
  const int material = body.mesh->model.mesh.region[static_cast<std::size_t>(element)];
  return body.laws[static_cast<std::size_t>(material)].cut_toughness;
}

std::span<const std::array<std::size_t, 2>> BladeCells::edges() const noexcept {
  return hexes_ != nullptr ? std::span<const std::array<std::size_t, 2>>(hex_edges) : std::span(tet_edges);
}

BladeCells::Nodes BladeCells::nodes(Index cell) const noexcept {
  Nodes all;
  const auto take = [&all](const auto& some) {
    all.n = some.size();
    std::ranges::copy(some, all.of.begin());
  };
  if (!are_elements()) return {{cell}, 1};
  if (!is_skin(cell)) {
    if (tets_ != nullptr)
      take(tets_->corners(cell));
    else if (triangles_ != nullptr)
      take(triangles_->corners(cell));
    else
      take(hexes_->corners(cell));
    return all;
  }
  const Skin& skin = faces_[face_of(cell)];
  if (tets_ != nullptr)
    take(tets_->face(skin.element, skin.face));
  else if (triangles_ != nullptr)
    take(triangles_->face(skin.element, skin.face));
  else
    take(hexes_->face(skin.element, skin.face));
  return all;
}

Vec3 BladeCells::rest(Index cell) const noexcept {
  return are_elements() ? rest_[static_cast<std::size_t>(cell)] : body_->body().rest_position(cell);
}

}  // namespace palpate::physics
