#pragma once
// The picture without a window: takes messages, draws when asked, writes PNG files. No GL in this header.

#include <cstddef>
#include <memory>
#include <string>

#include "common/message/messages.h"
#include "common/scene/colour_kind.h"
#include "common/scene/section_spec.h"
#include "render_node/image/image.h"

namespace palpate::render {

class ViewModel;

/// Smooth edges take four samples a pixel; where the processor does the drawing that doubles the cost of a frame.
enum class Edges { plain, smooth };

class Picture {
 public:
  /// @param scene  is copied. Size, camera and what is shown come from its [render] table.
  /// @throws InputError if this machine cannot draw without a screen
  explicit Picture(const Scene& scene, Edges edges = Edges::smooth);
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  void take(const BodySurface& chunk);
  void take(const SurfaceChange& page);
  void take(const VertexBlock& block);
  void take(const ToolWrench& wrench);
  void take(const HapticTrace& trace);
  void take(const NodeStatus& status);

  /// Draws everything taken so far. The same messages and times give the same bytes on the same machine.
  /// @param t  simulated time, shown in the panel [s]
  void draw(double t);

  /// The next draw() draws all of the picture, not what changed alone: the same pixels, for who wants to compare.
  void draw_whole() noexcept;

  const Image& image() const noexcept;  // of the last draw()
  /// Writes the last draw(). @throws InputError if the file cannot be written
  void save_png(const std::string& path) const;

  std::size_t facets_visible() const noexcept;
  std::size_t facets_total() const noexcept;
  std::size_t bytes_uploaded() const noexcept;  // to the graphics card by the last draw()
  double drawn_share() const noexcept;  // of the pixels, by the last draw(); the others were as before
  /// The threshold that the panel shows, after somebody commanded another.
  void set_threshold(double intensity) noexcept;
  /// The section, likewise.
  void set_section(const std::optional<SectionSpec>& section) noexcept;
  /// From which intensity on what lies inside is shown, likewise.
  void set_inside(const std::optional<double>& from) noexcept;
  /// What colours say, likewise.
  void set_colour(ColourKind kind) noexcept;

  ViewModel& model() noexcept;
  const ViewModel& model() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace palpate::render
