#pragma once
// Puts the chunks of a BodySurface together. Chunks may come in any order and more than once; only a revision whose
// chunks have all come is handed out, so that the old picture stays until the new one is whole. Memory grows with what has
// come, never with what a chunk says is to come.

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "render_node/model/memory_budget.h"
#include "render_node/model/surface.h"

namespace palpate::render {

enum class ChunkFate {
  kept,       // the revision still lacks chunks
  completed,  // finished() has the surface
  stale,      // of a revision that is shown already, or older than the one being assembled
  malformed,  // counts or corners that break the promises of messages.h, or chunks that do not make a whole
  too_large,  // no room is left for it
};

class SurfaceAssembly {
 public:
  explicit SurfaceAssembly(std::shared_ptr<MemoryBudget> budget = std::make_shared<MemoryBudget>())
      : budget_(std::move(budget)) {}

  /// Takes one chunk. A newer revision than the one being assembled drops the older, unfinished one.
  ChunkFate take(const BodySurface& chunk);

  /// Moves the completed surface out; call after ChunkFate::completed.
  Surface finished();

  /// Somebody else sends surfaces from now on and numbers them anew: any revision is a newer one.
  void begin_anew() noexcept {
    shown_revision_ = 0;
    pending_.reset();
  }

  /// Revision being assembled; 0: none.
  std::uint32_t pending_revision() const noexcept { return pending_ ? pending_->surface.revision : 0; }

 private:
  struct Part {
    std::uint32_t first_vertex = 0, first_facet = 0;
    std::vector<Array3f> position;
    std::vector<Corners> corners;
    std::vector<std::uint32_t> rgba;
  };
  struct Pending {
    Surface surface;  // without its arrays until it is whole
    std::uint32_t n_chunks = 0, n_vertices = 0, n_facets = 0;
    std::map<std::uint32_t, Part> parts;
    MemoryHold memory;
  };
  static bool well_formed(const BodySurface& chunk) noexcept;
  bool belongs(const BodySurface& chunk) const noexcept;
  void start(const BodySurface& chunk);
  bool keep(const BodySurface& chunk);
  bool join();

  std::shared_ptr<MemoryBudget> budget_;
  std::uint32_t shown_revision_ = 0;
  std::optional<Pending> pending_;
};

}  // namespace palpate::render
