#pragma once
// The changes of a surface as the pages in which they are sent: a list that only grows (SurfaceChange in messages.h).

#include <functional>
#include <span>

#include "common/message/messages.h"

namespace palpate::physics {

// What a sample weighs on the wire, with its version and without what DDS adds. [bytes]
inline constexpr std::size_t chunk_bytes = sizeof(BodySurface) + sizeof(std::uint32_t);
inline constexpr std::size_t page_bytes = sizeof(SurfaceChange) + sizeof(std::uint32_t);

class ChangePages {
 public:
  /// Of a surface that has just been numbered anew: nothing has changed yet.
  void begin(std::uint32_t body, std::uint32_t revision, std::uint32_t n_vertices) noexcept;

  struct Totals {
    std::uint32_t facets = 0, hidden = 0;  // after these changes
  };
  /// Adds what one new surface changes. Every page that is new or longer goes to the sink. @return pages
  int add(std::span<const Array3f> vertices, std::span<const FacetChange> facets, const Totals& totals,
          const std::function<void(const SurfaceChange&)>& sink);

  /// No more pages than these are needed for so much.
  static constexpr std::size_t most_pages(std::size_t vertices, std::size_t facets) noexcept {
    return 1 + vertices / max_change_vertices + facets / max_change_facets;
  }

 private:
  void turn() noexcept;

  SurfaceChange page_;  // the last one
};

}  // namespace palpate::physics
