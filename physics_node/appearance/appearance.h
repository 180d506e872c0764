#pragma once
// What render_node is told: the visible surface of every body once per revision, then only the blocks of vertices
// that moved. Free of DDS: the messages go to whoever asks.

#include <functional>
#include <future>
#include <optional>
#include <vector>

#include "common/message/messages.h"
#include "physics_node/surface/surface.h"
#include "physics_node/world.h"

namespace palpate::physics {

class Appearance {
 public:
  /// @param threshold  intensity from which tissue is shown; absent: all tissue
  Appearance(const World& world, std::optional<double> threshold);

  /// Shows tissue from another intensity on. The new surfaces are made by a thread of their own; poll() takes them.
  void set_threshold(double threshold);

  /// Takes finished surfaces, and follows elements that broke. @return true if write_surfaces has something new
  bool poll();

  /// All chunks of every body whose surface is new since the last call. @return chunks
  int write_surfaces(const std::function<void(const BodySurface&)>& sink);

  /// Blocks in which a vertex moved by more than a hundredth of a millimetre, or changed its flags, since they were
  /// last written. @return blocks
  int write_blocks(const std::function<void(const VertexBlock&)>& sink);

  /// Writes every block again next time: somebody new is looking.
  void resend();

  std::size_t facets_visible() const;
  std::size_t facets_total() const;

 private:
  struct View {
    Surface surface;
    std::uint32_t revision = 1;
    bool published = false;
    std::vector<Array3f> sent;             // positions as last written (n_moving)
    std::vector<std::uint8_t> sent_flags;  // (n_moving)
  };
  void show(std::size_t body, Surface surface);
  bool block_changed(const View& view, const MovingBody& moving, std::size_t first, std::size_t last) const;
  void write_chunk(std::size_t body, std::uint32_t chunk,
                   const std::function<void(const BodySurface&)>& sink);

  const World& world_;
  std::vector<View> views_;
  std::future<std::vector<std::pair<std::size_t, Surface>>> pending_;
  std::optional<double> wanted_;  // threshold asked for while another is being made
  std::int64_t broken_seen_ = 0;
  std::int64_t frames_seen_ = 0;
  std::unique_ptr<BodySurface> chunk_ = std::make_unique<BodySurface>();
  std::unique_ptr<VertexBlock> block_ = std::make_unique<VertexBlock>();
};

}  // namespace palpate::physics
