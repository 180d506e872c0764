#pragma once
// What render_node is told: the visible surface of every body once per revision, then only the blocks of vertices
// that moved. Free of DDS: the messages go to whoever asks.

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "common/message/messages.h"
#include "physics_node/boundary/surface.h"
#include "physics_node/world.h"

namespace palpate::physics {

/// Who makes a surface anew: poll() itself, so that pictures are the same each time, or a thread of its own meanwhile, so
/// that frames go on.
enum class Remake { at_once, beside };

class Appearance {
 public:
  /// @param threshold  intensity from which tissue is shown; absent: all tissue
  Appearance(const World& world, std::optional<double> threshold, Remake how = Remake::at_once);

  /// Shows tissue from another intensity on; poll() takes the new surfaces.
  void set_threshold(double threshold);

  /// Takes finished surfaces, and follows elements that broke or came back: of each body that has such, a copy of its live
  /// elements goes into a new surface. Costs next to nothing where none has. Allocates: not for inside a frame.
  /// @return true if write_surfaces has something new
  bool poll();

  /// All chunks of every body whose surface is new since the last call. @return chunks
  int write_surfaces(const std::function<void(const BodySurface&)>& sink);

  /// Blocks in which a vertex moved by more than a hundredth of a millimetre, or changed its flags, since they were
  /// last written. @return blocks
  int write_blocks(const std::function<void(const VertexBlock&)>& sink);

  /// Writes every block again next time: somebody new is looking.
  void resend();

  std::size_t facets_visible() const;  // loose elements and masses are not facets
  std::size_t facets_total() const;

 private:
  struct View {
    Surface surface;
    std::unique_ptr<LiveElements> live;  // what it was, or is being, made from
    std::int64_t breaks = 0;             // of the body then
    std::uint32_t revision = 0;
    bool published = false;
    std::vector<Array3f> sent;             // positions as last written (n_moving)
    std::vector<std::uint8_t> sent_flags;  // (n_moving)
  };
  using Made = std::vector<std::pair<std::size_t, Surface>>;
  Surface make(std::size_t body) const;
  std::vector<std::size_t> outdated();
  void show(std::size_t body, Surface surface);
  bool block_changed(const View& view, const NodeMotion& moving, std::size_t first, std::size_t last) const;
  void write_chunk(std::size_t body, std::uint32_t chunk,
                   const std::function<void(const BodySurface&)>& sink);

  const World& world_;
  std::vector<View> views_;
  std::optional<double> threshold_;  // of the surfaces shown or being made
  std::optional<double> wanted_;     // threshold asked for since
  Remake how_;
  std::int64_t restored_ = 0;  // how often the guard had gone back when surfaces were last looked at
  std::unique_ptr<BodySurface> chunk_ = std::make_unique<BodySurface>();
  std::unique_ptr<VertexBlock> block_ = std::make_unique<VertexBlock>();
  std::vector<Condition> conditions_ =
      std::vector<Condition>(max_block_vertices);  // of the block that is looked at
  std::future<Made> pending_;  // the last member: it is waited for before what it reads goes
};

}  // namespace palpate::physics
