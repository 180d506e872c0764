#pragma once
// What is shown of one body, ready for upload, and what of it changed since the last upload.

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "render_node/model/memory_budget.h"
#include "render_node/model/surface.h"
#include "render_node/model/surface_assembly.h"
#include "render_node/model/surface_changes.h"
#include "render_node/model/surface_normals.h"

namespace palpate::render {

/// Normal and state of a vertex, packed for the graphics card.
struct PackedVertex {
  std::array<std::int16_t, 3> normal{};  // times 32767
  std::uint16_t flags = 0;               // vertex_yielded, vertex_broken
  friend bool operator==(const PackedVertex&, const PackedVertex&) = default;
};

struct VertexRange {
  std::size_t first = 0, n = 0;
};

class BodyPicture {
 public:
  explicit BodyPicture(std::shared_ptr<MemoryBudget> budget = std::make_shared<MemoryBudget>())
      : assembly_(budget), changes_(budget), held_memory_(budget), shown_memory_(budget) {}

  /// Takes a chunk; when it completes a newer revision, that becomes the picture.
  ChunkFate take(const BodySurface& chunk);

  /// Takes a page of changes; when they are complete up to some change, they are made to the picture.
  ChunkFate take(const SurfaceChange& page);

  /// Moves vertices of the revision shown. A block of a newer revision, or of vertices that are still to come, is held until those
  /// are there (only changed blocks are sent, so it may not come again); blocks may overtake surfaces.
  /// @return false: of another revision or not finite, or no room is left to hold it: ignored
  bool take(const VertexBlock& block);

  /// Another physics sends from now on and numbers revisions anew. What is shown stays until its surface is whole.
  void begin_anew() noexcept;

  /// Brings normals and packed vertices up to date; call before reading them.
  void refresh();

  bool empty() const noexcept { return surface_.revision == 0; }
  const Surface& surface() const noexcept { return surface_; }
  std::vector<Array3f> const& rest() const noexcept { return rest_; }  // of each vertex [m]
  /// How far the vertex is from there that is farthest. Cost: a pass over all. [m]
  float farthest() const noexcept;
  /// What colours show, as physics has computed it; 0 where it has not.  (n_vertices)
  std::vector<float> const& field() const noexcept { return field_; }
  float most_field() const noexcept;  // cost: a pass over all
  std::vector<PackedVertex> const& packed() const noexcept { return packed_; }
  std::vector<std::uint32_t> const& vertex_rgba() const noexcept {
    return vertex_rgba_;
  }                                                                  // mean of its facets
  std::size_t facets_visible() const noexcept { return n_facets_; }  // without elements and masses
  std::size_t facets_total() const noexcept { return facets_visible() + surface_.facets_hidden; }

  /// Box round the first revision, so that the view does not jump when something is cut away.
  const Eigen::AlignedBox3f& first_box() const noexcept { return first_box_; }

  /// Mean length of the edges of the first revision; 0 before it came [m].
  float edge_length() const noexcept { return edge_length_; }

  // What changed since clear_dirty(). All: facets, colours and vertices; else ranges of vertices.
  bool all_dirty() const noexcept { return all_dirty_; }
  std::vector<VertexRange> dirty_ranges() const;
  std::span<const std::uint32_t> dirty_vertices() const noexcept { return dirty_; }  // each once, no order
  void clear_dirty();

 private:
  static constexpr std::size_t page_vertices = 512;  // granularity of dirty ranges
  bool hold(const VertexBlock& block);
  void take_held();
  void let_go_of_held() noexcept;
  void show(Surface surface);
  void follow_surface();
  void apply(const VertexBlock& block);
  void touch(std::uint32_t vertex) {
    if (is_dirty_[vertex] != 0) return;
    is_dirty_[vertex] = 1;
    dirty_.push_back(vertex);
  }
  void pack(std::size_t vertex);

  SurfaceAssembly assembly_;
  SurfaceChanges changes_;
  std::map<std::uint32_t, VertexBlock> held_;  // newest of each block of held_revision_
  std::uint32_t held_revision_ = 0;
  MemoryHold held_memory_, shown_memory_;
  std::uint32_t revision_ = 0;  // of the surface shown, as blocks number it; 0: its sender has gone

  Surface surface_;
  SurfaceNormals normals_;
  std::vector<Array3f> rest_;               // (n_vertices)
  std::vector<std::uint32_t> vertex_rgba_;  // (n_vertices)
  std::vector<std::uint8_t> flags_;         // (n_vertices)
  std::vector<float> field_;                // (n_vertices)
  std::vector<PackedVertex> packed_;        // (n_vertices)
  Eigen::AlignedBox3f first_box_;
  float edge_length_ = 0;
  std::size_t n_facets_ = 0;

  bool rebuild_ = false;
  std::vector<std::uint32_t> moved_;    // since the last refresh(), each once
  std::vector<std::uint8_t> is_moved_;  // (n_vertices)
  bool all_dirty_ = false;
  std::vector<std::uint32_t> dirty_;
  std::vector<std::uint8_t> is_dirty_;  // (n_vertices)
};

}  // namespace palpate::render
