#pragma once
// Puts the chunks of a BodySurface together. Chunks may come in any order and more than once; only a revision whose
// chunks have all come is handed out, so that the old picture stays until the new one is whole.

#include <optional>
#include <vector>

#include "render_node/model/surface.h"

namespace palpate::render {

enum class ChunkFate {
  kept,       // the revision still lacks chunks
  completed,  // finished() has the surface
  stale,      // of a revision that is shown already, or older than the one being assembled
  malformed,  // counts or corners that break the promises of messages.h
};

class SurfaceAssembly {
 public:
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
  struct Pending {
    Surface surface;
    std::vector<bool> has;  // (n_chunks)
    std::uint32_t missing = 0;
  };
  static bool well_formed(const BodySurface& chunk) noexcept;
  bool belongs(const BodySurface& chunk) const noexcept;
  void start(const BodySurface& chunk);
  void copy(const BodySurface& chunk);

  std::uint32_t shown_revision_ = 0;
  std::optional<Pending> pending_;
};

}  // namespace palpate::render
