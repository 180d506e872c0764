// A face-centred cubic lattice in a shape or in an image.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "physics_node/body/build_lattice.h"
#include "physics_node/body/solid_shape.h"
#include "physics_node/body/trim.h"

namespace palpate::physics {
namespace {

constexpr int fewest_elements = 3;  // that hold a mass of a needle in place

/// How the grid lies in the frame of the body.
struct Laying {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  // columns: axes of the grid
  Vec3 anchor = Vec3::Zero();                          // a place with a mass
  Bounds bounds;                                       // of all masses
};

Laying laying_of(const BodySpec& body) {
  Laying laying;
  laying.bounds = bounds_of(body);
  if (std::holds_alternative<BoxShape>(body.shape)) laying.anchor = laying.bounds.lo;
  // The edge of a knife lies along a row of neighbours, a face diagonal of the cubic cell, so that no gap in it is wider
  // than the spacing.
  if (std::holds_alternative<KnifeShape>(body.shape))
    laying.turn = Eigen::AngleAxisd(0.25 * std::numbers::pi, Vec3::UnitY()).toRotationMatrix();
  if (const auto* needle = std::get_if<NeedleShape>(&body.shape)) laying.anchor.x() = 0.5 * needle->diameter;
  return laying;
}

/// The bounds in grid steps from the anchor.
Bounds steps_from_anchor(const Laying& laying, double step) {
  Bounds steps{Vec3::Constant(1e9), Vec3::Constant(-1e9)};
  for (int s = 0; s < 8; ++s) {
    const Vec3 corner((s & 1 ? laying.bounds.hi : laying.bounds.lo).x(),
                      (s & 2 ? laying.bounds.hi : laying.bounds.lo).y(),
                      (s & 4 ? laying.bounds.hi : laying.bounds.lo).z());
    const Vec3 at = laying.turn.transpose() * (corner - laying.anchor) / step;
    steps.lo = steps.lo.cwiseMin(at);
    steps.hi = steps.hi.cwiseMax(at);
  }
  return steps;
}

/// A lattice whose grid is known in the frame of the body, too.
class Grid {
 public:
  Grid(const BodySpec& body, const Laying& laying)
      : laying_(laying), step_(*body.spacing / std::numbers::sqrt2) {
    const Bounds steps = steps_from_anchor(laying, step_);
    // The anchor is an even number of steps above the first grid coordinate.
    below_ = 2 * (-0.5 * steps.lo).array().max(0).ceil().cast<int>();
    extent_ = below_ + Vec3i(steps.hi.array().floor().cast<int>()) + Vec3i::Constant(2);
    const Eigen::Matrix3d axes = body.orientation * laying.turn;
    const Vec3 origin = body.at + body.orientation * laying.anchor - axes * (step_ * below_.cast<double>());
    lattice = make_lattice(LatticeKind::fcc, extent_, origin, Vec3::Constant(step_), axes);
  }

  /// Place of a grid coordinate in the frame of the body.
  Vec3 place(const Vec3i& grid) const {
    return laying_.anchor + laying_.turn * (step_ * (grid - below_).cast<double>());
  }

  /// A mass wherever inside(place) says yes.
  template <class Inside>
  void fill(const Inside& inside) {
    for (int z = 0; z < extent_.z(); ++z)
      for (int y = 0; y < extent_.y(); ++y)
        for (int x = (y + z) & 1; x < extent_.x(); x += 2) {
          if (inside(place({x, y, z})))
            lattice.mass_share[static_cast<std::size_t>(lattice.cell_of({x, y, z}))] = 1.0F;
        }
  }

  void carve(Carver& carver) {
    for (Index cell = 0; cell < lattice.n_cells(); ++cell) {
      auto& share = lattice.mass_share[static_cast<std::size_t>(cell)];
      if (share > 0 && carver.takes(lattice.rest_position(cell))) share = 0;
    }
  }

  Lattice lattice;

 private:
  Laying laying_;
  double step_;
  Vec3i below_ = Vec3i::Zero(), extent_ = Vec3i::Zero();
};

void join_neighbours(Lattice& lattice) {
  const auto n_half = static_cast<std::size_t>(lattice.n_half);
  for (const Index cell : lattice.masses) {
    const auto kind = static_cast<std::size_t>(lattice.row_kind(cell));
    for (std::size_t d = 0; d < n_half; ++d) {
      const auto other = static_cast<std::size_t>(cell + lattice.offset[kind][d]);
      if (lattice.mass_share[other] <= 0) continue;
      auto& mine = lattice.mask[static_cast<std::size_t>(cell)];
      auto& theirs = lattice.mask[other];
      mine = static_cast<Mask>(mine | (1U << d));
      theirs = static_cast<Mask>(theirs | (1U << (d + n_half)));
    }
  }
}

/// The lowest place of a mass, and of several as low the one furthest to -x, in the middle between -y and +y.
Vec3 lowest_place(const Grid& grid) {
  constexpr double same = 1e-9;  // [m]
  Vec3 sum = Vec3::Zero();
  double count = 0;
  const auto visit = [&](const auto& use) {
    for (Index cell = 0; cell < grid.lattice.n_cells(); ++cell)
      if (grid.lattice.mass_share[static_cast<std::size_t>(cell)] > 0)
        use(grid.place(grid.lattice.grid_of(cell)));
  };
  double z = 1e9, x = 1e9;
  visit([&](const Vec3& p) { z = std::min(z, p.z()); });
  visit([&](const Vec3& p) { x = p.z() < z + same ? std::min(x, p.x()) : x; });
  visit([&](const Vec3& p) {
    if (p.z() > z + same || p.x() > x + same) return;
    sum += p;
    ++count;
  });
  return count > 0 ? Vec3(sum / count) : sum;
}

/// Takes away what swings at the end of the bevel, cuts the shaft to length and moves it so that its lowest mass is the tip.
void finish_needle(const BodySpec& body, Grid& grid) {
  drop_loose_masses(grid.lattice, fewest_elements);
  const Vec3 tip = lowest_place(grid);
  const double hub = tip.z() + std::get<NeedleShape>(body.shape).length + on_surface;
  for (Index cell = 0; cell < grid.lattice.n_cells(); ++cell)
    if (grid.place(grid.lattice.grid_of(cell)).z() > hub)
      grid.lattice.mass_share[static_cast<std::size_t>(cell)] = 0;
  grid.lattice.origin -= body.orientation * tip;
}

}  // namespace

Lattice fcc_lattice(const BodySpec& body) {
  Grid grid(body, laying_of(body));
  grid.fill([&body](const Vec3& p) { return holds(body, p, on_surface); });
  if (const auto layers = wall_layers_of(body)) {
    const bool hollow = keep_outer_layers(
        grid.lattice, *layers, [&](const Vec3i& at) { return beyond_outer_wall(body, grid.place(at)); });
    if (!hollow)
      throw InputError(
          fmt::format("{}: body \"{}\" is filled by its wall; make it wider or spacing_mm smaller",
                      body.place.text(), body.name));
  }
  if (std::holds_alternative<NeedleShape>(body.shape)) finish_needle(body, grid);
  Carver carver(body);
  grid.carve(carver);
  carver.refuse_unused();
  index_masses(grid.lattice);
  join_neighbours(grid.lattice);
  return std::move(grid.lattice);
}

Lattice fcc_lattice(const BodySpec& body, const Cells& image) {
  Laying laying;
  const Vec3 half = 0.5 * image.spacing.cwiseProduct(image.size.cast<double>());
  laying.bounds = {-half, half};
  Grid grid(body, laying);
  grid.fill([&](const Vec3& p) {
    const Vec3i at = image.cell_at(body.at + p);
    return image.is_filled(at.x(), at.y(), at.z());
  });
  Carver carver(body);  // the image is carved already, as sharply as its cells are small
  grid.carve(carver);
  if (std::get<VolumeShape>(body.shape).largest_component) keep_largest_part(grid.lattice);
  index_masses(grid.lattice);
  join_neighbours(grid.lattice);
  return std::move(grid.lattice);
}

}  // namespace palpate::physics
