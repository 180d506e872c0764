#include "render_node/view/pixel_box.h"

#include <cmath>

namespace palpate::render {
namespace {

// Why: measured with `palpate bench render`, where the processor draws. Tools and chunks that lie in two boxes are worked on twice,
// and a box of 8,000 pixels costs hardly less than one of 80,000.
constexpr std::int64_t pixels_a_box = 100000;

}  // namespace

PixelBoxes::Part PixelBoxes::joined(const Part& a, const Part& b) {
  Part both = a;
  both.box.extend(b.box);
  const PixelBox shared{std::max(a.box.x0, b.box.x0), std::max(a.box.y0, b.box.y0),
                        std::min(a.box.x1, b.box.x1), std::min(a.box.y1, b.box.y1)};
  both.added = std::min(both.box.pixels(), a.added + b.added - std::min({shared.pixels(), a.added, b.added}));
  return both;
}

void PixelBoxes::add(const PixelBox& box) { add(Part{box, box.pixels()}); }

void PixelBoxes::add(const PixelBoxes& others) {
  for (const Part& part : others.parts_) add(part);
}

void PixelBoxes::add(Part part) {
  if (part.box.empty()) return;
  // Joined to one it may have come near to another. What nobody added is bounded, or a row of boxes askew would grow to one that
  // holds all of the picture.
  const auto near = [&part](const Part& other) {
    const Part both = joined(part, other);
    return both.box.pixels() - both.added <= pixels_a_box + both.added / 4;
  };
  for (auto other = std::ranges::find_if(parts_, near); other != parts_.end();
       other = std::ranges::find_if(parts_, near)) {
    part = joined(part, *other);
    parts_.erase(other);
  }
  parts_.push_back(part);
}

std::int64_t PixelBoxes::pixels() const noexcept {
  std::int64_t sum = 0;
  for (const Part& part : parts_) sum += part.box.pixels();
  return sum;
}

PixelBox pixels_of(const Lens& lens, const Eigen::AlignedBox3f& box,
                   const Eigen::Matrix4f& world_from_model) {
  constexpr float margin =
      2;  // Why: half a line, and a pixel of what the graphics card rounds elsewhere [px]
  if (box.isEmpty()) return {};
  const Eigen::Matrix4f clip_from_model = lens.clip_from_world * world_from_model;
  Eigen::Array2f lower = Eigen::Array2f::Constant(1e9F), upper = -lower;
  for (int corner = 0; corner < 8; ++corner) {
    Eigen::Vector4f p;
    p << box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(corner)), 1;
    const Eigen::Vector4f clip = clip_from_model * p;
    if (!(clip.w() > 1e-6F)) return all_pixels(lens);
    const Eigen::Array2f at = clip.head<2>().array() / clip.w();
    lower = lower.min(at);
    upper = upper.max(at);
  }
  const Eigen::Array2f size(static_cast<float>(lens.width), static_cast<float>(lens.height));
  // Clamped before it becomes an integer: a box far beside the picture is no pixel at all.
  const Eigen::Array2f from = ((0.5F * (lower + 1) * size).floor() - margin).max(0.0F).min(size);
  const Eigen::Array2f to = ((0.5F * (upper + 1) * size).ceil() + margin).max(0.0F).min(size);
  return {static_cast<int>(from.x()), static_cast<int>(from.y()), static_cast<int>(to.x()),
          static_cast<int>(to.y())};
}

}  // namespace palpate::render
