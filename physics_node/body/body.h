#pragma once
// One [[body]] as it stands after loading: never changes while stepping.

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/math/vec3.h"
#include "common/scene/scene_fwd.h"
#include "physics_node/body/adjacency.h"
#include "physics_node/body/cells.h"
#include "physics_node/body/element_law.h"
#include "physics_node/body/mesh_body.h"
#include "physics_node/body/solid_elements.h"
#include "physics_node/lattice/cell_net.h"
#include "physics_node/lattice/lattice.h"

namespace palpate::physics {

/// A node is known by its number alone, which is below `capacity`, and for which nobody outside the rooms that make and step
/// bodies computes.
struct Body {
  std::string name;
  Lattice lattice;                 // empty where the body is a mesh
  std::shared_ptr<MeshBody> mesh;  // of a body of tetrahedra or a surface of springs; else null
  ElementLaw law;                  // of its own material
  std::vector<ElementLaw> laws;    // of each material in it; laws[0] is `law`
  std::vector<std::uint8_t>
      law_of;  // of each storage cell, an index of laws (n_cells); EMPTY: all masses have `law`
  std::optional<SolidElements>
      solid;                     // of a body of finite elements; else its elements are springs of `laws`
  std::optional<Cells> cells;    // of a voxel body; an fcc body has none
  std::vector<float> intensity;  // of each storage cell, of an fcc body in an image; else EMPTY (n_cells)
  std::vector<double>
      inverse_mass;  // of each storage cell or node of a mesh, 0: held or empty [1/kg]  (capacity)
  Vec3 velocity = Vec3::Zero();  // at the start [m/s]
  Index n_held = 0;              // masses that do not move
  bool may_be_cut = false;       // a tool of the scene cuts
  std::vector<Index>
      handle;               // storage cells of the masses that a hand drives, in storage order; of tools only
  Vec3 tip = Vec3::Zero();  // where the hand's tip is while the body is at rest: at_mm of the scene [m]

  /// All nodes as loaded, in a fixed order.
  std::span<const Index> nodes() const noexcept { return mesh ? mesh->nodes : lattice.masses; }
  Index n_nodes() const noexcept { return static_cast<Index>(nodes().size()); }
  /// The number of every node is below this, and of every copy of one.
  Index capacity() const noexcept {
    return (mesh ? n_nodes() : lattice.n_cells()) + static_cast<Index>(most_copies());
  }
  std::size_t most_copies() const noexcept {
    if (mesh) return mesh->most_copies();
    return cell_net() != nullptr ? cell_net()->most_copies() : 0;
  }
  /// Of cells of finite elements that may be cut; else null.
  CellNet* cell_net() const noexcept { return solid ? solid->net.get() : nullptr; }
  /// Calls visit(node) for all nodes that there are now: those as loaded, then the copies that cuts have made.
  template <class Visit>
  void each_node(const Visit& visit) const noexcept {
    for (const Index node : nodes()) visit(node);
    each_copy(visit);
  }
  /// The same of copies alone.
  template <class Visit>
  void each_copy(const Visit& visit) const noexcept {
    const auto visit_all = [&](const auto& net) {
      for (Index node = net.n_loaded(); node < net.n_nodes(); ++node) visit(node);
    };
    if (mesh && mesh->copies() != nullptr) visit_all(*mesh->copies());
    if (const CellNet* net = cell_net()) visit_all(*net);
  }
  /// The node as loaded that this is, or is a copy of.
  Index origin(Index node) const noexcept {
    if (mesh) return mesh->origin(node);
    return cell_net() != nullptr ? cell_net()->origin(node) : node;
  }
  Vec3 rest_position(Index node) const noexcept {  // [m]
    return mesh ? mesh->rest(node) : lattice.rest_position(origin(node));
  }
  /// How far neighbours lie apart, by which distances of contact go: of a mesh those on its faces, in the mean [m].
  double spacing() const noexcept { return mesh ? mesh->spacing : lattice.spacing(); }
  std::int64_t n_elements() const { return mesh ? mesh->n_elements() : lattice.n_elements(); }
  Adjacency adjacency() const noexcept {  // as loaded
    return mesh ? Adjacency(mesh->neighbours) : Adjacency(lattice);
  }
  /// Pieces of a step that threads may share.
  std::size_t n_pieces() const noexcept {
    return mesh ? 1 + static_cast<std::size_t>(mesh->n_elements()) / elements_a_piece : lattice.chunks.size();
  }
  double longest_element() const noexcept {  // at rest [m]
    return mesh ? mesh->longest_edge
                : *std::max_element(lattice.rest_length.begin(), lattice.rest_length.end());
  }
  /// Is a node part of no cell that is seen? It moves with the others and nobody touches it.
  bool is_beyond(Index node) const noexcept { return !mesh && lattice.is_beyond(origin(node)); }

 private:
  static constexpr std::size_t elements_a_piece = 1024;  // Why: no block of tetrahedra has more
};

/// The law of the mass in a storage cell.
inline const ElementLaw& law_at(const Body& body, Index cell) {
  return body.law_of.empty() ? body.law : body.laws[body.law_of[static_cast<std::size_t>(cell)]];
}
/// [kg]
inline double node_mass(const Body& body, Index node) {
  const auto n = static_cast<std::size_t>(node);
  if (body.mesh) return body.mesh->mass[n];
  return body.solid ? body.solid->mass[n] : law_at(body, node).mass;
}
/// Springs on the edges of a closed surface of triangles.
inline bool is_surface_of_springs(const Body& body) { return body.mesh && body.mesh->springs; }
/// Finite elements, in cells or in tetrahedra; else springs.
inline bool is_of_finite_elements(const Body& body) {
  return body.solid || (body.mesh && !body.mesh->springs);
}
/// Its faces bear a small tip rather than its nodes.
inline bool bears_by_faces(const Body& body) { return body.solid || body.mesh; }
/// Is only a part of it stepped, and the rest stands?
inline bool is_awake_in_parts(const Body& body) { return body.solid && body.solid->awake_radius > 0; }
/// Of a body, those that are stepped: all, or where it is awake in parts about as many as wake under one finger on a flat skin.
double stepped_masses(const Body& body) noexcept;
/// Does it stay where it is, whoever pushes it?
inline bool is_anchored(const Body& body) { return body.n_held > 0 || is_awake_in_parts(body); }
/// viscosity / modulus of finite elements and of surfaces [s]
inline double damper_time(const Body& body) {
  return body.mesh ? body.mesh->model.beta : body.solid ? body.solid->beta : 0;
}
/// Springs that yield and break.
inline bool any_yields(const Body& body) {
  return !body.solid &&
         std::any_of(body.laws.begin(), body.laws.end(), [](const ElementLaw& law) { return law.yields; });
}
/// Are there springs that a tool may cut, or tetrahedra, triangles or cells that it may part?
inline bool any_cut(const Body& body) {
  if (!body.may_be_cut) return false;
  return body.solid ? body.solid->net != nullptr : !body.mesh || body.mesh->copies() != nullptr;
}
/// May springs or finite elements go, of themselves or because a tool cuts them?
inline bool any_breaks(const Body& body) {
  return body.solid ? !body.solid->failures.empty() : any_yields(body) || any_cut(body);
}
/// May it come apart, as that or as its cells are parted?
inline bool may_come_apart(const Body& body) { return any_breaks(body) || any_cut(body); }
/// Of cells of finite elements: do they do no more than hang together, so that a cut may part them? What yields, breaks or remembers is not
/// cut.
inline bool is_parted_where_cut(const Body& body) {
  return body.solid && body.solid->failures.empty() && body.solid->yields.empty() &&
         body.solid->relaxation.empty();
}
/// Finite elements that yield.
inline bool any_cells_yield(const Body& body) { return body.solid && !body.solid->yields.empty(); }
/// May what it goes through leave a trace?
inline bool may_change_for_good(const Body& body) { return any_breaks(body) || any_cells_yield(body); }
inline bool any_damped(const Body& body) {
  return std::any_of(body.laws.begin(), body.laws.end(), [](const ElementLaw& law) { return law.damped; });
}
/// Do dampers or drag of springs take energy from it?
inline bool any_springs_lose(const Body& body) {
  if (body.solid) return false;
  return any_damped(body) ||
         std::any_of(body.laws.begin(), body.laws.end(), [](const ElementLaw& law) { return law.drag > 0; });
}

/// For a body that a tool of the scene cuts: of tetrahedra of first order, of surfaces of springs and of cells of finite
/// elements all of whose materials say how tough they are, room for the copies of their nodes.
/// @throws InputError  more elements at a node than SimplexNet has room for
void make_ready_for_cuts(const BodySpec& spec, const std::vector<MaterialSpec>& materials, Body& body);

/// Builds a body's lattice or mesh, its laws, held masses and handle. Held are the masses within a quarter of a grid step of a face; where
/// those are a single row, which would be a hinge, and for a handle, the masses within three quarters of the spacing: on fcc the two
/// outermost layers.
/// Faces are those of the masses in the body's own frame. Of a mesh, held are the nodes within a quarter of the spacing of a face.
/// @param materials  of the scene; the body and its regions name them, and they must be there
/// @throws InputError; also where a face of a mesh holds less than an area
Body build_body(const BodySpec& spec, const std::vector<MaterialSpec>& materials);
/// A body of one material, whatever it is called.
Body build_body(const BodySpec& spec, const MaterialSpec& material);

}  // namespace palpate::physics
