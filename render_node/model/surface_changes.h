#pragma once
// Changes of a surface from the pages of SurfaceChange. Pages may come in any order, more than once, and before their surface; they
// are carried out when all up to some change are there, so that no picture shows half of one.

#include <map>
#include <memory>

#include "render_node/model/memory_budget.h"
#include "render_node/model/surface.h"
#include "render_node/model/surface_assembly.h"

namespace palpate::render {

class SurfaceChanges {
 public:
  explicit SurfaceChanges(std::shared_ptr<MemoryBudget> budget) : memory_(std::move(budget)) {}

  /// Keeps one page. @return kept, stale or too_large
  ChunkFate take(const SurfaceChange& page);

  /// Carries out what is complete, if it is of this surface. New vertices are where they were when they were new.
  /// @param memory  grows with the surface
  /// @return completed: the surface has changed; kept: it has not; malformed: what is complete breaks promises of messages.h, and
  ///         nothing more will be made of this revision; too_large: the same, as no room is left for it
  ChunkFate carry_out(Surface& surface, MemoryHold& memory);

  /// Somebody else sends surfaces from now on and numbers them anew.
  void begin_anew() noexcept { begin(0); }

 private:
  using Pages = std::map<std::uint32_t, std::unique_ptr<SurfaceChange>>;
  void begin(std::uint32_t revision) noexcept;
  ChunkFate give_up(ChunkFate why) noexcept;
  Pages::const_iterator last_of_the_complete(const Surface& surface) const;
  bool fits(const Surface& surface, Pages::const_iterator last) const;
  void forget_until(std::uint32_t page);

  std::uint32_t revision_ = 0;  // of all below
  bool given_up_ = false;
  std::uint32_t page_ = 0;    // the last one that was carried out, perhaps not full then
  std::uint32_t n_done_ = 0;  // changes of facets that have been carried out
  std::uint32_t change_ = 0;  // up to which all has been
  Pages waiting_;
  MemoryHold memory_;
};

}  // namespace palpate::render
