#include "physics_node/boundary/smooth_skin.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "physics_node/body/build_lattice.h"
#include "physics_node/body/skin_crossings.h"

namespace palpate::physics {
namespace {

constexpr int n_faces = 12;

int bit(unsigned octant, int axis) { return static_cast<int>(octant >> axis & 1); }

/// The face across an axis at an octant and the one beyond it.
int face_at(unsigned octant, int axis) {
  const int b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2;
  return 4 * axis + bit(octant, b) + 2 * bit(octant, c);
}

/// The octant below a face.
unsigned below(int face) {
  const int axis = face / 4, b = axis == 0 ? 1 : 0, c = axis == 2 ? 1 : 2;
  return static_cast<unsigned>((face & 1) << b | (face >> 1 & 1) << c);
}

SkinFans find_fans(unsigned filled) {
  const auto is_filled = [&](unsigned o) { return (filled >> o & 1) != 0; };
  std::array<int, n_faces> root;
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int f) {
    while (root[static_cast<std::size_t>(f)] != f) f = root[static_cast<std::size_t>(f)];
    return f;
  };
  const auto join = [&](int f, int g) {
    f = find(f), g = find(g);
    root[static_cast<std::size_t>(std::max(f, g))] = std::min(f, g);
  };
  const auto there = [&](int f) { return is_filled(below(f)) != is_filled(below(f) | 1U << f / 4); };
  for (int axis = 0; axis < 3; ++axis)
    for (unsigned side = 0; side < 2; ++side) {
      const int b = (axis + 1) % 3, c = (axis + 2) % 3;
      const unsigned o = side << axis;
      const std::array<unsigned, 4> around{o, o | 1U << b, o | 1U << b | 1U << c, o | 1U << c};
      std::array<int, 4> face{};  // between each and the next
      int n = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        face[k] = face_at(around[k], k % 2 == 0 ? b : c);
        n += there(face[k]) ? 1 : 0;
      }
      for (std::size_t k = 0; k < 4; ++k) {
        const int before = face[(k + 3) % 4], after = face[k];
        if (n == 4 && is_filled(around[k])) join(before, after);
        if (n != 2 || !there(after)) continue;
        for (std::size_t m = 0; m < 4; ++m)
          if (there(face[m])) join(after, face[m]);
      }
    }
  SkinFans fans;
  std::array<int, n_faces> number;
  number.fill(-1);
  for (int f = 0; f < n_faces; ++f) {
    if (!there(f)) continue;
    int& of_root = number[static_cast<std::size_t>(find(f))];
    if (of_root < 0) of_root = fans.n++;
    auto& faces = fans.faces[static_cast<std::size_t>(of_root)];
    faces = static_cast<std::uint16_t>(faces | 1U << f);
  }
  // Cells without a face there go with a neighbour.
  std::array<int, 8> of_octant;
  of_octant.fill(-1);
  for (unsigned o = 0; o < 8; ++o)
    for (int axis = 0; axis < 3; ++axis)
      if (const int f = face_at(o, axis); is_filled(o) && there(f))
        of_octant[o] = number[static_cast<std::size_t>(find(f))];
  for (int round = 0; round < 3; ++round)
    for (unsigned o = 0; o < 8; ++o)
      for (int axis = 0; axis < 3; ++axis)
        if (const int other = of_octant[o ^ 1U << axis]; is_filled(o) && of_octant[o] < 0)
          of_octant[o] = other;
  for (unsigned o = 0; o < 8; ++o) fans.of_octant[o] = static_cast<std::uint8_t>(std::max(of_octant[o], 0));
  return fans;
}

}  // namespace

const SkinFans& skin_fans(unsigned filled) noexcept {
  static const std::array<SkinFans, 256> all = [] {
    std::array<SkinFans, 256> made;
    for (unsigned m = 0; m < made.size(); ++m) made[m] = find_fans(m);
    return made;
  }();
  return all[filled];
}

SmoothSkin::SmoothSkin(const Body& body, std::optional<double> threshold)
    : body_(body),
      cells_(*body.cells),
      threshold_(cells_.intensity.empty() ? std::nullopt : threshold),
      shift_(lattice_corner(cells_, body.lattice)) {
  const auto length = static_cast<std::uint64_t>(cells_.size.x());
  row_.assign(static_cast<std::size_t>(cells_.size.y()) * static_cast<std::size_t>(cells_.size.z()) + 1, 0);
  for (const SkinCrossing& crossing : cells_.crossings) ++row_[crossing.face / 6 / length + 1];
  std::partial_sum(row_.begin(), row_.end(), row_.begin());
}

double SmoothSkin::intensity(const Vec3i& cell) const noexcept {
  return static_cast<double>(cells_.intensity[cells_.index(cell.x(), cell.y(), cell.z())]);
}

bool SmoothSkin::shown(const Vec3i& cell) const noexcept {
  return cells_.is_filled(cell.x(), cell.y(), cell.z()) && (!threshold_ || intensity(cell) >= *threshold_);
}

const SkinFans& SmoothSkin::fans(const Vec3i& corner) const noexcept {
  unsigned filled = 0;
  for (unsigned o = 0; o < 8; ++o)
    if (shown(cell_at(corner, o))) filled |= 1U << o;
  return skin_fans(filled);
}

int SmoothSkin::fan(const Vec3i& corner, const Vec3i& cell) const noexcept {
  const SkinFans& all = fans(corner);
  if (all.n == 0) return -1;
  const Vec3i at = cell - corner + Vec3i::Ones();
  return all.of_octant[static_cast<std::size_t>(at.x() + 2 * at.y() + 4 * at.z())];
}

/// Where a threshold hides tissue it ends at that.
double SmoothSkin::crossing(const Vec3i& in, int axis, bool up) const noexcept {
  const Vec3i out = in + (up ? 1 : -1) * Vec3i::Unit(axis);
  const bool inside = cells_.inside(out.x(), out.y(), out.z());
  double share = 1;
  if (!cells_.is_filled(out.x(), out.y(), out.z())) {
    const std::uint64_t face = 6 * static_cast<std::uint64_t>(cells_.index(in.x(), in.y(), in.z())) +
                               static_cast<std::uint64_t>(2 * axis + (up ? 1 : 0));
    const std::size_t row = static_cast<std::size_t>(in.y()) +
                            static_cast<std::size_t>(cells_.size.y()) * static_cast<std::size_t>(in.z());
    const auto first = cells_.crossings.begin() + row_[row], last = cells_.crossings.begin() + row_[row + 1];
    const auto found = std::lower_bound(first, last, face,
                                        [](const SkinCrossing& c, std::uint64_t f) { return c.face < f; });
    if (found != last && found->face == face) share = found->share;
  }
  if (threshold_ && inside && intensity(out) < *threshold_) {
    const double above = intensity(in) - *threshold_, under = *threshold_ - intensity(out);
    share = std::min(share, std::clamp(above / (above + under), least_crossing, 1 - least_crossing));
  }
  return share;
}

Vec3 SmoothSkin::place(const Vec3i& corner, int fan) const noexcept {
  const std::uint16_t faces = fans(corner).faces[static_cast<std::size_t>(fan)];
  Vec3 sum = Vec3::Zero();
  int n = 0;
  for (int f = 0; f < n_faces; ++f) {
    if ((faces >> f & 1) == 0) continue;
    const int axis = f / 4;
    const Vec3i lower = cell_at(corner, below(f)), upper = lower + Vec3i::Unit(axis);
    const bool up = shown(lower);
    Vec3 at = (up ? lower : upper).cast<double>() + Vec3::Constant(0.5);
    at[axis] += (up ? 1 : -1) * crossing(up ? lower : upper, axis, up);
    sum += at;
    ++n;
  }
  return cells_.corner + cells_.spacing.cwiseProduct(sum / n);
}

Bearers bearers_in_cell(const Body& body, const Vec3i& shift, const Vec3i& cell, const Vec3& place,
                        const CellNet::Corners* corners) noexcept {
  const Vec3 xi = (place - body.cells->corner).cwiseQuotient(body.cells->spacing) - cell.cast<double>();
  Bearers by;
  for (unsigned o = 0; o < 8; ++o) {
    const Vec3i at(bit(o, 0), bit(o, 1), bit(o, 2));
    double w = 1;
    for (int a = 0; a < 3; ++a) w *= at[a] != 0 ? xi[a] : 1 - xi[a];
    const Index node = corners != nullptr ? (*corners)[o] : body.lattice.mass_at(cell + at - shift);
    if (node < 0) return {};
    if (w == 0) continue;
    by.weight[by.n] = w;
    by.node[by.n++] = node;
  }
  return by;
}

bool SmoothSkin::is_beside_scenery(const Vec3i& corner) const noexcept {
  for (unsigned o = 0; o < 8; ++o)
    if (const Vec3i cell = cell_at(corner, o);
        cells_.is_filled(cell.x(), cell.y(), cell.z()) && !cells_.is_deformable(cell.x(), cell.y(), cell.z()))
      return true;
  return false;
}

/// Octant of the cell that holds the place, else the nearest of its fan, else the nearest of all; -1: none lives.
int SmoothSkin::holder_among(const Vec3i& corner, int fan, const Vec3& place, unsigned lives) const noexcept {
  const SkinFans& all = fans(corner);
  const Vec3 away =
      (place - cells_.corner) - cells_.spacing.cwiseProduct(corner.cast<double>());  // from the corner [m]
  const unsigned holder = (away.x() > 0 ? 1U : 0U) | (away.y() > 0 ? 2U : 0U) | (away.z() > 0 ? 4U : 0U);
  if ((lives >> holder & 1) != 0) return static_cast<int>(holder);
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (const bool of_fan : {true, false}) {
    for (unsigned o = 0; o < 8; ++o) {
      if ((lives >> o & 1) == 0) continue;
      bool mine = false;
      for (int a = 0; a < 3; ++a)
        mine = mine || (all.n > 0 && (all.faces[static_cast<std::size_t>(fan)] >> face_at(o, a) & 1) != 0);
      if (mine != of_fan) continue;
      double square = 0;
      for (int a = 0; a < 3; ++a) {
        const double outside = std::max(0.0, bit(o, a) != 0 ? -away[a] : away[a]);
        square += outside * outside;
      }
      if (square < least) least = square, best = static_cast<int>(o);
    }
    if (best >= 0) break;
  }
  return best;
}

Bearers SmoothSkin::bearers_among(const Vec3i& corner, int fan, const Vec3& place,
                                  unsigned lives) const noexcept {
  const Index own = body_.lattice.mass_at(corner - shift_);
  if (own < 0) return {};
  if (is_beside_scenery(corner)) return Bearers::alone(own);
  const int holder = holder_among(corner, fan, place, lives);
  if (holder < 0) return Bearers::alone(own);
  return bearers_in_cell(body_, shift_, cell_at(corner, static_cast<unsigned>(holder)), place);
}

}  // namespace palpate::physics
