#include "physics_node/boundary/section_surface.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "physics_node/body/build_lattice.h"
#include "physics_node/boundary/cut_cells.h"
#include "physics_node/boundary/smooth_skin.h"

namespace palpate::physics {
namespace {

constexpr std::size_t most_looks = 100'000;
constexpr double left_out = 0.02;  // of intensities, at each end of the scale
constexpr double darker = 0.8;

std::uint32_t grey_of(double intensity, const GreyScale& grey) {
  // Why the root: of a CT bone takes most of the scale, and soft tissue would be black.
  const double share = std::sqrt(std::clamp((intensity - grey.black) / (grey.white - grey.black), 0.01, 1.0));
  const auto level = static_cast<std::uint32_t>(std::lround(255 * share));
  return 0xFF000000U | level << 16U | level << 8U | level;
}

std::uint32_t dark(std::uint32_t rgba) {
  std::uint32_t made = rgba & 0xFF000000U;
  for (unsigned shift = 0; shift < 24; shift += 8)
    made |= static_cast<std::uint32_t>(std::lround(darker * (rgba >> shift & 0xFFU))) << shift;
  return made;
}

class Layer {
 public:
  Layer(const Body& body, const LiveElements& live, const SectionSpec& section)
      : body_(body),
        cells_(*body.cells),
        cut_(body, live),
        shift_(lattice_corner(cells_, body.lattice)),
        section_(section),
        across_{(section.axis + 1) % 3, (section.axis + 2) % 3} {
    if (SmoothSkin::is_on(body)) skin_.emplace(body, std::nullopt);
    const double in_cells = (section.at - cells_.corner[section.axis]) / cells_.spacing[section.axis];
    // Why: within the body's box a plane on the last face still shows its last layer.
    const int n = cells_.size[section.axis];
    layer_ = in_cells < 0 || in_cells > n ? -1 : std::min(static_cast<int>(in_cells), n - 1);
  }

  Surface build(const GreyScale& grey, std::uint32_t rgba) {
    if (layer_ < 0) return {};
    for (int k = 0; k < cells_.size[across_[1]]; ++k)
      for (int j = 0; j < cells_.size[across_[0]]; ++j) {
        const Vec3i at = cell(j, k);
        if (!is_shown(at)) continue;
        facets_.push_back({number(j, k), number(j + 1, k), number(j + 1, k + 1), number(j, k + 1)});
        const bool image = !cells_.intensity.empty();
        surface_.rgba.push_back(
            image ? grey_of(static_cast<double>(cells_.intensity[cells_.index(at.x(), at.y(), at.z())]), grey)
                  : dark(rgba));
        surface_.site.push_back(static_cast<std::uint32_t>(cells_.index(at.x(), at.y(), at.z())));
      }
    return finish();
  }

 private:
  Vec3i cell(int j, int k) const {
    Vec3i at;
    at[section_.axis] = layer_, at[across_[0]] = j, at[across_[1]] = k;
    return at;
  }
  bool is_shown(const Vec3i& c) const { return cells_.is_filled(c.x(), c.y(), c.z()) && !cut_.is_cut(c); }
  bool moves(const Vec3i& c) const { return cells_.is_deformable(c.x(), c.y(), c.z()) && !cut_.is_cut(c); }

  /// Of the corner (j, k) of the layer, negative for scenery, as in voxel_surface().
  std::int64_t number(int j, int k) {
    const std::int64_t key = j + (cells_.size[across_[0]] + 1LL) * k;
    const auto found = numbers_.find(key);
    if (found != numbers_.end()) return found->second;
    const Vec3 place = place_of(j, k);
    const Bearers by = bearers_of(j, k, place);
    std::int64_t value = 0;
    if (by.n > 0) {
      value = static_cast<std::int64_t>(surface_.cell.size());
      const auto heaviest = std::max_element(by.weight.begin(), by.weight.begin() + by.n) - by.weight.begin();
      surface_.cell.push_back(by.node[static_cast<std::size_t>(heaviest)]);
      surface_.rest.push_back(place);
      surface_.bearers.push_back(by);
      surface_.fan.push_back(no_fan);
    } else {
      scenery_.push_back(place);
      value = -static_cast<std::int64_t>(scenery_.size());
    }
    numbers_.emplace(key, value);
    return value;
  }

  /// At its outline, of a smooth skin, the mean of where the tissue ends between the four cells around it.
  Vec3 place_of(int j, int k) const {
    std::array<double, 2> in_cells = {static_cast<double>(j), static_cast<double>(k)};
    const auto filled = [&](int dj, int dk) {
      const Vec3i c = cell(j + dj, k + dk);
      return cells_.is_filled(c.x(), c.y(), c.z());
    };
    std::array<double, 2> sum = {0, 0};
    int n = 0;
    for (std::size_t a = 0; skin_ && a < 2; ++a)
      for (int side = -1; side <= 0; ++side) {
        const std::array<int, 2> lower = a == 0 ? std::array{-1, side} : std::array{side, -1},
                                 upper = a == 0 ? std::array{0, side} : std::array{side, 0};
        const bool up = filled(lower[0], lower[1]);
        if (up == filled(upper[0], upper[1])) continue;
        const auto& in = up ? lower : upper;
        const double share = skin_->crossing(cell(j + in[0], k + in[1]), across_[a], up);
        std::array<double, 2> at = {in[0] + 0.5, in[1] + 0.5};
        at[a] += up ? share : -share;
        sum[0] += at[0], sum[1] += at[1];
        ++n;
      }
    if (n == 2) in_cells[0] += sum[0] / 2, in_cells[1] += sum[1] / 2;
    Vec3 place;
    place[section_.axis] = section_.at;
    for (std::size_t a = 0; a < 2; ++a)
      place[across_[a]] = cells_.corner[across_[a]] + in_cells[a] * cells_.spacing[across_[a]];
    return place;
  }

  /// The cell around the corner that holds the place, or else the nearest; none where scenery is beside it.
  Bearers bearers_of(int j, int k, const Vec3& place) const {
    std::optional<Vec3i> best;
    double least = 0;
    for (int dk = -1; dk <= 0; ++dk)
      for (int dj = -1; dj <= 0; ++dj) {
        const Vec3i c = cell(j + dj, k + dk);
        if (!cells_.is_filled(c.x(), c.y(), c.z())) continue;
        if (!cells_.is_deformable(c.x(), c.y(), c.z())) return {};
        if (!moves(c)) continue;
        const double away =
            (place - cells_.centre_of(c.x(), c.y(), c.z())).cwiseQuotient(cells_.spacing).norm();
        if (!best || away < least) best = c, least = away;
      }
    return best ? bearers_in_cell(body_, shift_, *best, place) : Bearers{};
  }

  Surface finish() {
    const auto n_moving = static_cast<std::int64_t>(surface_.cell.size());
    surface_.rest.insert(surface_.rest.end(), scenery_.begin(), scenery_.end());
    for (const auto& facet : facets_) {
      auto& corners = surface_.facets.emplace_back();
      for (std::size_t c = 0; c < 4; ++c)
        corners[c] = static_cast<std::uint32_t>(facet[c] >= 0 ? facet[c] : n_moving - facet[c] - 1);
    }
    return std::move(surface_);
  }

  const Body& body_;
  const Cells& cells_;
  CutCells cut_;
  Vec3i shift_;
  SectionSpec section_;
  std::array<int, 2> across_;  // the other axes
  std::optional<SmoothSkin> skin_;
  int layer_ = -1;  // -1: beside the body
  std::unordered_map<std::int64_t, std::int64_t> numbers_;
  std::vector<Vec3> scenery_;
  std::vector<std::array<std::int64_t, 4>> facets_;
  Surface surface_;
};

}  // namespace

GreyScale grey_scale_of(const Cells& cells) {
  std::vector<float> some;
  const std::size_t stride = 1 + cells.filled.size() / most_looks;
  for (std::size_t n = 0; n < cells.intensity.size(); n += stride)
    if (cells.filled[n] != 0) some.push_back(cells.intensity[n]);
  if (some.empty()) return {};
  std::sort(some.begin(), some.end());
  const auto out = static_cast<std::size_t>(left_out * static_cast<double>(some.size()));
  GreyScale grey{static_cast<double>(some[out]), static_cast<double>(some[some.size() - 1 - out])};
  if (!(grey.white > grey.black)) grey.white = grey.black + 1;
  return grey;
}

Surface section_surface(const Body& body, const LiveElements& live, const SectionSpec& section,
                        const GreyScale& grey, std::uint32_t rgba) {
  return Layer(body, live, section).build(grey, rgba);
}

}  // namespace palpate::physics
