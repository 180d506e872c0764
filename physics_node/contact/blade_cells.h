#pragma once
// What an edge goes between in a body: cells that stay whole and hang together until it has passed between them. Of a
// lattice of springs these are its masses; of tetrahedra they are the tetrahedra, and their outer faces, so that
// tissue reaches as far as its skin.
//
// A cell is where its nodes are in the mean, and what presses on it presses on each of them alike, s = 1 / their number:
// force on a node F_n = sum of s F, and a cell gives way by sum of s F_n / m_n.

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
  /// @param body  a lattice of springs, or tetrahedra that may be cut; outlives this
  explicit BladeCells(const BodyModel& body);

  /// Numbers of all.
  std::span<const Index> all() const noexcept { return net_ != nullptr ? numbers_ : body_->body().nodes(); }
  std::size_t capacity() const noexcept {  // numbers are below it
    return net_ != nullptr ? numbers_.size() : static_cast<std::size_t>(body_->body().capacity());
  }
  /// How far cells lie apart [m]; no two that are joined lie farther apart than 1.5 of it. Of tetrahedra no less than
  /// what an edge presses in before it cuts.
  double spacing() const noexcept { return h_; }
  double toughness(Index cell) const noexcept;  // [J/m^2]

  struct Nodes {
    std::array<Index, 4> of{};
    std::size_t n = 1;
    std::span<const Index> list() const noexcept { return {of.data(), n}; }
  };
  Nodes nodes(Index cell) const noexcept;
  Vec3 rest(Index cell) const noexcept;      // [m]
  Vec3 position(Index cell) const noexcept;  // [m]
  Vec3 velocity(Index cell) const noexcept;  // [m/s]
  Vec3 corner(Index node) const noexcept { return body_->position(node); }
  /// Calls visit(other) for each that it hangs together with.
  template <class Visit>
  void each_joined(Index cell, const Visit& visit) const noexcept {
    if (net_ == nullptr) return body_->adjacency().each_neighbour(cell, visit);
    if (cell >= net_->n_tets()) {
      if (passed_[face_of(cell)] == 0) visit(faces_[face_of(cell)].tet);
      return;
    }
    for (std::size_t f = 0; f < 4; ++f) {
      const Index other = net_->beyond(cell, f);
      if (other != TetNet::none && !net_->is_open(cell, f)) visit(other);
      if (other != TetNet::none) continue;
      const auto skin = static_cast<std::size_t>(skin_[4 * static_cast<std::size_t>(cell) + f]);
      if (passed_[skin] == 0) visit(net_->n_tets() + static_cast<Index>(skin));
    }
  }
  bool have_volumes() const noexcept { return net_ != nullptr; }
  /// Is it of a volume, of which a plane has a section, or a point?
  bool has_section(Index cell) const noexcept { return net_ != nullptr && cell < net_->n_tets(); }
  /// Has the edge gone between a tetrahedron and its skin? Nothing of the body comes apart there.
  bool is_skin(Index cell) const noexcept { return net_ != nullptr && cell >= net_->n_tets(); }
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
    Index tet = 0;
    std::size_t face = 0;
  };
  std::size_t face_of(Index cell) const noexcept { return static_cast<std::size_t>(cell - net_->n_tets()); }
  template <class Of>
  Vec3 mean(Index cell, const Of& of) const noexcept {
    const Nodes at = nodes(cell);
    Vec3 sum = Vec3::Zero();
    for (const Index node : at.list()) sum += of(node);
    return sum / static_cast<double>(at.n);
  }

  const BodyModel* body_ = nullptr;
  const TetNet* net_ = nullptr;  // null: a lattice
  double h_ = 1;
  std::vector<Index> numbers_;        // of a mesh
  std::vector<Skin> faces_;           // outer ones as loaded
  std::vector<std::int32_t> skin_;    // 4 tet + face: its number in faces_; -1: none
  std::vector<std::uint8_t> passed_;  // of each of faces_
};

}  // namespace palpate::physics
