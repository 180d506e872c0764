#pragma once
// What an edge goes between in a body: cells that stay whole and hang together until it has passed between them. Of a
// lattice of springs these are its masses; of finite elements they are the elements, tetrahedra or cells of the lattice, and
// their outer faces, so that tissue reaches as far as its skin; of a surface of springs its triangles.
//
// A cell is where its nodes are in the mean, and what presses on it presses on each of them alike, s = 1 / their number:
// force on a node F_n = sum of s F, and a cell gives way by sum of s F_n / m_n.

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "physics_node/step/body_model.h"

namespace palpate::physics {

class BladeCells {
 public:
  /// Of nothing.
  BladeCells() = default;
  /// @param body  a lattice of springs, or finite elements that may be cut; outlives this
  explicit BladeCells(const BodyModel& body);

  /// Numbers of all.
  std::span<const Index> all() const noexcept { return are_elements() ? numbers_ : body_->body().nodes(); }
  /// Calls visit(cell) for each that may lie in a box now, and maybe for others; one or all of them, always in the same order. Cost: of a
  /// body that is awake in parts what lies about the box, else all.
  template <class Visit>
  void each_within(const Eigen::AlignedBox3d& box, const Visit& visit) const noexcept {
    if (hexes_ == nullptr || body_->parts() == nullptr) {
      for (const Index cell : all()) visit(cell);
      return;
    }
    const Lattice& lattice = body_->body().lattice;
    const Vec3 margin = Vec3::Constant(body_->parts()->most_moved) + lattice.step;
    const auto [low, high] = grid_box(lattice, box.min() - margin, box.max() + margin);
    Vec3i at;
    for (at.z() = low.z(); at.z() <= high.z(); ++at.z())
      for (at.y() = low.y(); at.y() <= high.y(); ++at.y())
        for (at.x() = low.x(); at.x() <= high.x(); ++at.x()) {
          const Index cell = lattice.cell_of(at);
          if (!hexes_->has_cell(cell)) continue;
          visit(cell);
          each_skin(cell, CellNet::n_faces, visit);
        }
  }
  std::size_t capacity() const noexcept {  // numbers are below it
    return are_elements() ? static_cast<std::size_t>(first_skin_) + faces_.size()
                          : static_cast<std::size_t>(body_->body().capacity());
  }
  /// How far cells lie apart [m]; no two that are joined lie farther apart than 1.5 of it. Of elements no less than
  /// what an edge presses in before it cuts.
  double spacing() const noexcept { return h_; }
  double toughness(Index cell) const noexcept;  // [J/m^2]

  struct Nodes {
    std::array<Index, 8> of{};
    std::size_t n = 1;
    std::span<const Index> list() const noexcept { return {of.data(), n}; }
  };
  /// As long as splits() is the same.
  Nodes nodes(Index cell) const noexcept;
  /// How many nodes have split in two.
  Index splits() const noexcept {
    if (hexes_ != nullptr) return hexes_->n_copies();
    if (tets_ != nullptr) return tets_->n_copies();
    return triangles_ != nullptr ? triangles_->n_copies() : 0;
  }
  /// How thick a surface is; 0: it is none [m]
  double wall() const noexcept {
    return triangles_ != nullptr ? body_->body().mesh->springs->membrane.thickness : 0;
  }
  Vec3 rest(Index cell) const noexcept;                                                   // [m]
  Vec3 position(Index cell) const noexcept { return place_of(rest(cell), nodes(cell)); }  // [m]
  /// Of a cell that lies there at rest and has these nodes. [m], [m/s]
  Vec3 place_of(const Vec3& rest, const Nodes& of) const noexcept {
    return rest + mean(of, [this](Index node) { return body_->displacement(node); });
  }
  Vec3 velocity_of(const Nodes& of) const noexcept {
    return mean(of, [this](Index node) { return body_->velocity(node); });
  }
  Vec3 corner(Index node) const noexcept { return body_->position(node); }
  Vec3 rest_corner(Index node) const noexcept { return body_->body().rest_position(node); }
  /// Calls visit(other) for each that it hangs together with.
  template <class Visit>
  void each_joined(Index cell, const Visit& visit) const noexcept {
    if (is_skin(cell)) {
      if (passed_[face_of(cell)] == 0) visit(faces_[face_of(cell)].element);
      return;
    }
    if (tets_ != nullptr) return each_beyond(*tets_, 4, cell, visit);
    if (triangles_ != nullptr) return each_beyond(*triangles_, 3, cell, visit);
    if (hexes_ != nullptr) return each_beyond(*hexes_, CellNet::n_faces, cell, visit);
    body_->adjacency().each_neighbour(cell, visit);
  }
  /// Of a volume: has it come apart from one beside it?
  bool has_parted(Index cell) const noexcept {
    if (tets_ != nullptr) return any_open(*tets_, 4, cell);
    return hexes_ != nullptr && any_open(*hexes_, CellNet::n_faces, cell);
  }
  bool have_volumes() const noexcept { return tets_ != nullptr || hexes_ != nullptr; }
  /// Elements, whose nodes part, or masses that springs join?
  bool are_elements() const noexcept { return have_volumes() || triangles_ != nullptr; }
  bool is_element(Index cell) const noexcept { return are_elements() && cell < first_skin_; }
  /// Is it of a volume, of which a plane has a section, or a point?
  bool has_section(Index cell) const noexcept { return have_volumes() && cell < first_skin_; }
  /// Which of the nodes of such a volume its edges join.
  std::span<const std::array<std::size_t, 2>> edges() const noexcept;
  /// Has the edge gone between an element and its skin? Nothing of the body comes apart there.
  bool is_skin(Index cell) const noexcept { return are_elements() && cell >= first_skin_; }
  void pass_skin(Index cell) noexcept { passed_[face_of(cell)] = 1; }
  void reset() noexcept { passed_.assign(passed_.size(), 0); }

  /// How forces on cells make these give way. Once add() was called for all, of() tells of one; then clear().
  class Response {
   public:
    Response() = default;
    explicit Response(std::size_t n_nodes) : at_(n_nodes, Vec3::Zero()) {}
    void add(const Nodes& nodes, const Vec3& force) noexcept {
      const double s = 1.0 / static_cast<double>(nodes.n);
      for (const Index node : nodes.list()) at_[static_cast<std::size_t>(node)] += s * force;
    }
    /// sum of s F_n / m_n. @param inverse_mass  of nodes [1/kg]
    Vec3 of(const Nodes& nodes, const std::vector<double>& inverse_mass) const noexcept {
      const double s = 1.0 / static_cast<double>(nodes.n);
      Vec3 sum = Vec3::Zero();
      for (const Index node : nodes.list())
        sum += s * inverse_mass[static_cast<std::size_t>(node)] * at_[static_cast<std::size_t>(node)];
      return sum;
    }
    void clear(const Nodes& nodes) noexcept {
      for (const Index node : nodes.list()) at_[static_cast<std::size_t>(node)].setZero();
    }

   private:
    std::vector<Vec3> at_;  // by node
  };
  std::size_t n_body_nodes() const noexcept { return static_cast<std::size_t>(body_->body().capacity()); }
  const std::vector<double>& inverse_mass() const noexcept { return body_->body().inverse_mass; }

 private:
  struct Skin {
    Index element = 0;
    std::size_t face = 0;
  };
  std::size_t face_of(Index cell) const noexcept { return static_cast<std::size_t>(cell - first_skin_); }
  template <class Net>
  void number_elements(const Net& net, std::span<const Index> elements, std::size_t n_faces);
  template <class Net>
  static bool any_open(const Net& net, std::size_t n_faces, Index cell) noexcept {
    bool any = false;
    for (std::size_t f = 0; f < n_faces && !any; ++f) any = net.is_open(cell, f);
    return any;
  }
  template <class Net, class Visit>
  void each_beyond(const Net& net, std::size_t n_faces, Index cell, const Visit& visit) const noexcept {
    for (std::size_t f = 0; f < n_faces; ++f) {
      const Index other = net.beyond(cell, f);
      if (other != Net::none && !net.is_open(cell, f)) visit(other);
      if (other != Net::none) continue;
      const auto skin = static_cast<std::size_t>(skin_[n_faces * static_cast<std::size_t>(cell) + f]);
      if (passed_[skin] == 0) visit(first_skin_ + static_cast<Index>(skin));
    }
  }
  /// Calls visit(number) of the outer faces of an element.
  template <class Visit>
  void each_skin(Index element, std::size_t n_faces, const Visit& visit) const noexcept {
    for (std::size_t f = 0; f < n_faces; ++f)
      if (const std::int32_t skin = skin_[n_faces * static_cast<std::size_t>(element) + f]; skin >= 0)
        visit(first_skin_ + skin);
  }
  template <class Of>
  static Vec3 mean(const Nodes& at, const Of& of) noexcept {
    Vec3 sum = Vec3::Zero();
    for (const Index node : at.list()) sum += of(node);
    return sum / static_cast<double>(at.n);
  }

  const BodyModel* body_ = nullptr;
  const TetNet* tets_ = nullptr;            // null: no tetrahedra
  const TriangleNet* triangles_ = nullptr;  // null: no surface of springs
  const CellNet* hexes_ = nullptr;          // null: no cells; with all three a lattice of springs
  double h_ = 1;
  Index first_skin_ = 0;              // elements have numbers below it
  std::vector<Index> numbers_;        // of elements, then of outer faces
  std::vector<Vec3> rest_;            // of each of them, by number [m]
  std::vector<Skin> faces_;           // outer ones as loaded
  std::vector<std::int32_t> skin_;    // by element and face: its number in faces_; -1: none
  std::vector<std::uint8_t> passed_;  // of each of faces_
};

}  // namespace palpate::physics
