#include "physics_node/body/skin_crossings.h"

#include <algorithm>
#include <cmath>

#include "common/scene/body_spec.h"
#include "physics_node/body/solid_shape.h"

namespace palpate::physics {
namespace {

constexpr int halvings = 30;  // Why: 1e-9 of a cell
constexpr double at_face = 0.5;

/// One body, asked face by face.
class Walls {
 public:
  Walls(const BodySpec& body, const Cells& cells)
      : body_(body), cells_(cells), image_(std::get_if<VolumeShape>(&body.shape)) {}

  /// @param in, out  a filled cell, and an empty one beside it
  double crossing(const Vec3i& in, const Vec3i& out) const {
    if (image_ != nullptr && !cells_.inside(out.x(), out.y(), out.z())) return at_face;
    const Vec3 from = centre(in), to = centre(out);
    double share = image_ != nullptr
                       ? by_intensity(in, out)
                       : wall(from, to, [&](const Vec3& p) { return holds(body_, p - body_.at, 0.0); });
    for (const CavitySpec& cavity : body_.cavities)
      share = std::min(share, wall(from, to, [&](const Vec3& p) {
                         return !std::visit([&](const auto& where) { return holds(where, p); }, cavity.where);
                       }));
    return std::clamp(share > 1 ? at_face : share, least_crossing, 1 - least_crossing);
  }

 private:
  static constexpr double nowhere = 2;

  Vec3 centre(const Vec3i& cell) const { return cells_.centre_of(cell.x(), cell.y(), cell.z()); }
  double phi(const Vec3i& cell) const {
    const auto intensity = static_cast<double>(cells_.intensity[cells_.index(cell.x(), cell.y(), cell.z())]);
    return std::min(intensity - image_->keep_min, image_->keep_max - intensity);
  }
  double by_intensity(const Vec3i& in, const Vec3i& out) const {
    const double phi_in = phi(in), phi_out = phi(out);
    if (phi_out >= 0 && !body_.cavities.empty()) return nowhere;
    const double sum = std::max(phi_in, 0.0) + std::abs(phi_out);
    return sum > 0 ? std::max(phi_in, 0.0) / sum : at_face;
  }
  /// Share of the way after which `inside` ends; `nowhere` where it does not.
  template <class Inside>
  static double wall(const Vec3& from, const Vec3& to, const Inside& inside) {
    if (inside(to)) return nowhere;
    double lo = 0, hi = 1;
    for (int n = 0; n < halvings; ++n) {
      const double middle = 0.5 * (lo + hi);
      (inside(from + middle * (to - from)) ? lo : hi) = middle;
    }
    return 0.5 * (lo + hi);
  }

  const BodySpec& body_;
  const Cells& cells_;
  const VolumeShape* image_;
};

}  // namespace

void find_crossings(const BodySpec& body, Cells& cells) {
  const Walls walls(body, cells);
  cells.crossings.clear();
  for (int k = 0; k < cells.size.z(); ++k)
    for (int j = 0; j < cells.size.y(); ++j)
      for (int i = 0; i < cells.size.x(); ++i) {
        if (!cells.is_filled(i, j, k)) continue;
        for (int face = 0; face < 6; ++face) {
          const Vec3i in(i, j, k), out = in + (2 * (face & 1) - 1) * Vec3i::Unit(face / 2);
          if (cells.is_filled(out.x(), out.y(), out.z())) continue;
          cells.crossings.push_back(
              {6 * static_cast<std::uint64_t>(cells.index(i, j, k)) + static_cast<std::uint64_t>(face),
               walls.crossing(in, out)});
        }
      }
}

}  // namespace palpate::physics
