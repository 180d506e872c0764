#pragma once
// Rectangles of pixels of a picture, and which pixels a box in space covers.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace palpate::render {

/// From the lower left corner of the picture; the upper limits are not part of it. [px]
struct PixelBox {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  bool empty() const noexcept { return x1 <= x0 || y1 <= y0; }
  int width() const noexcept { return empty() ? 0 : x1 - x0; }
  int height() const noexcept { return empty() ? 0 : y1 - y0; }
  std::int64_t pixels() const noexcept { return std::int64_t{width()} * height(); }
  void extend(const PixelBox& other) noexcept {
    if (other.empty()) return;
    if (empty())
      *this = other;
    else
      *this = {std::min(x0, other.x0), std::min(y0, other.y0), std::max(x1, other.x1),
               std::max(y1, other.y1)};
  }
  bool meets(const PixelBox& other) const noexcept {
    return !empty() && !other.empty() && x0 < other.x1 && other.x0 < x1 && y0 < other.y1 && other.y0 < y1;
  }
  friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

/// Few rectangles that cover all that was added and little else.
class PixelBoxes {
 public:
  /// Joined to one that is there, where drawing it by itself would cost more than the pixels between them.
  void add(const PixelBox& box);
  void add(const PixelBoxes& others);
  template <class F>
  void for_each(const F& what) const {
    for (const Part& part : parts_) what(part.box);
  }
  std::int64_t pixels() const noexcept;  // those twice covered count twice

 private:
  struct Part {
    PixelBox box;
    std::int64_t added = 0;  // pixels of it that were added, about
  };
  static Part joined(const Part& a, const Part& b);
  void add(Part part);
  std::vector<Part> parts_;
};

/// Where things appear.
struct Lens {
  Eigen::Matrix4f clip_from_world = Eigen::Matrix4f::Identity();
  int width = 0, height = 0;  // of the picture [px]
  Eigen::Vector3f eye = Eigen::Vector3f::Zero();
  friend bool operator==(const Lens&, const Lens&) = default;
};

/// All pixels on which something within the box may appear, with a margin for lines and rounding; all of the picture where the
/// box reaches behind the eye.
PixelBox pixels_of(const Lens& lens, const Eigen::AlignedBox3f& box,
                   const Eigen::Matrix4f& world_from_model = Eigen::Matrix4f::Identity());

inline PixelBox all_pixels(const Lens& lens) { return {0, 0, lens.width, lens.height}; }

}  // namespace palpate::render
