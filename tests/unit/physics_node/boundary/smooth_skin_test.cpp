// The smooth skin of cells: where it lies, that it is closed, and that it moves as the tissue does.
#include "physics_node/boundary/smooth_skin.h"

#include <gtest/gtest.h>

#include <bit>
#include <numbers>
#include <numeric>
#include <set>

#include "physics_node/body/build_lattice.h"
#include "physics_node/boundary/boundary.h"
#include "physics_node/boundary/live_skin.h"
#include "physics_node/step/body_model.h"
#include "tests/support/physics/small_worlds.h"
#include "tests/support/physics/smooth_image.h"
#include "tests/support/physics/surface_volume.h"

namespace palpate::physics {
namespace {

using namespace test;

Surface surface_of(const Body& body, std::optional<double> threshold = std::nullopt) {
  LiveElements all(body);
  all.copy(body, body.adjacency());
  return make_surface(body, all, threshold, 0);
}

/// Elements as loaded, but for cells that are gone.
LiveElements without(const Body& body, const std::function<bool(const Vec3i&)>& gone) {
  std::vector<Mask> masks;
  const Vec3i shift = lattice_corner(*body.cells, body.lattice);
  for (const Index node : body.nodes()) {
    const Vec3i at = shift + body.lattice.grid_of(node);
    Mask mask = body.lattice.mask[static_cast<std::size_t>(node)];
    for (unsigned o = 0; o < 8; ++o)
      if (gone(SmoothSkin::cell_at(at, o))) mask &= ~cell_bit(o);
    masks.push_back(mask);
  }
  LiveElements live(body);
  live.copy(body, masks);
  return live;
}

TEST(SkinFans, HoldEachFaceOnce) {
  for (unsigned filled = 0; filled < 256; ++filled) {
    const SkinFans& fans = skin_fans(filled);
    int faces = 0, there = 0;
    unsigned all = 0;
    for (int n = 0; n < fans.n; ++n) {
      ASSERT_NE(fans.faces[static_cast<std::size_t>(n)], 0);
      faces += std::popcount(static_cast<unsigned>(fans.faces[static_cast<std::size_t>(n)]));
      all |= fans.faces[static_cast<std::size_t>(n)];
    }
    for (unsigned o = 0; o < 8; ++o)
      for (unsigned a = 0; a < 3; ++a)
        if ((o >> a & 1) == 0) there += (filled >> o & 1) != (filled >> (o | 1U << a) & 1) ? 1 : 0;
    EXPECT_EQ(faces, there) << filled;
    EXPECT_EQ(std::popcount(all), there) << filled;
  }
}

TEST(SkinFans, PartWhereCellsMeetInACornerOrInAnEdgeOnly) {
  EXPECT_EQ(skin_fans(0).n, 0);
  EXPECT_EQ(skin_fans(255).n, 0);
  EXPECT_EQ(skin_fans(0b00000001).n, 1);
  EXPECT_EQ(skin_fans(0b10000001).n, 2);  // across the corner
  EXPECT_EQ(skin_fans(0b00001001).n, 2);  // across an edge
  EXPECT_EQ(skin_fans(0b00001111).n, 1);
  EXPECT_EQ(skin_fans(0b01101001).n, 4);  // every other one
  EXPECT_EQ(skin_fans(0b01111110).n, 2);  // a hole on either side
  const SkinFans& two = skin_fans(0b10000001);
  EXPECT_NE(two.of_octant[0], two.of_octant[7]);
}

TEST(SmoothSkin, OfABallLiesOnIt) {
  const Vec3 centre(0.37, -0.21, 0.55);
  const Body body = SmoothImage{}.body();
  const Surface surface = surface_of(body);
  SmoothImage rough;
  rough.skin = SkinKind::bricks;
  const Surface bricks = surface_of(rough.body());
  ASSERT_EQ(surface.facets.size(), bricks.facets.size());
  const auto off = [&](const Surface& of) {
    double sum = 0, most = 0;
    for (const Vec3& p : of.rest) {
      const double d = std::abs((1e3 * p - centre).norm() - 18.3) / 2;  // in cells
      sum += d, most = std::max(most, d);
    }
    return std::pair(sum / static_cast<double>(of.rest.size()), most);
  };
  const auto [mean, most] = off(surface);
  std::printf("from the ball, in cells: %.4f, at most %.3f; bricks %.3f, %.3f\n", mean, most,
              off(bricks).first, off(bricks).second);
  EXPECT_LT(mean, 0.035);
  EXPECT_LT(most, 0.2);
  EXPECT_GT(off(bricks).first, 0.2);
  const double volume = 4.0 / 3 * std::numbers::pi * std::pow(18.3e-3, 3);
  EXPECT_NEAR(volume_inside(surface) / volume, 1, 0.015);  // chords
  double cosine = 0;
  for (const auto& f : surface.facets) {
    const Vec3 area =
        (surface.rest[f[2]] - surface.rest[f[0]]).cross(surface.rest[f[3]] - surface.rest[f[1]]);
    Vec3 middle = -1e-3 * centre;
    for (const std::uint32_t c : f) middle += surface.rest[c] / 4;
    cosine += area.normalized().dot(middle.normalized());
  }
  EXPECT_GT(cosine / static_cast<double>(surface.facets.size()), std::cos(5 * std::numbers::pi / 180));
}

TEST(SmoothSkin, LiesWhereAWallOfAShapeDoes) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::sphere(18);
  recipe.spacing_mm = 2;
  recipe.body = "skin = \"smooth\"\n[[body.cavity]]\ncenter_mm = [0, 0, 0]\nradius_mm = 9\n";
  const Surface surface = surface_of(body_of(recipe));
  EXPECT_EQ(defects_of(surface).open_edges, 0);
  for (const Vec3& p : surface.rest) {
    const double r = 1e3 * p.norm();
    EXPECT_LT(std::min(std::abs(r - 18), std::abs(r - 9)), 0.5);
  }
  const double volume = 4.0 / 3 * std::numbers::pi * (std::pow(0.018, 3) - std::pow(0.009, 3));
  EXPECT_NEAR(volume_inside(surface) / volume, 1, 0.02);
}

/// Noise is the worst that an image can be.
TEST(SmoothSkin, OfNoiseIsClosedAndItsVerticesAreFans) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Dice dice(seed);
    SmoothImage noise;
    noise.size = {14, 13, 12};
    noise.phi = [&](const Vec3&) { return dice.between(-1, 1); };
    const Body body = noise.body();
    const Defects found = defects_of(surface_of(body));
    EXPECT_EQ(found.open_edges, 0) << seed;
    EXPECT_EQ(found.bad_vertices, 0) << seed;
    noise.skin = SkinKind::bricks;
    EXPECT_GT(defects_of(surface_of(noise.body())).bad_vertices, 20) << seed;
  }
}

TEST(SmoothSkin, IsCarriedByWeightsThatHoldItsPlace) {
  Dice dice(7);
  SmoothImage noise;
  noise.phi = [&](const Vec3& p) { return 20 - p.norm() + dice.between(-3, 3); };
  const Body body = noise.body();
  const Surface surface = surface_of(body);
  ASSERT_EQ(surface.bearers.size(), surface.n_moving());
  double most = 0;
  for (std::size_t v = 0; v < surface.n_moving(); ++v) {
    const Bearers& by = surface.bearers[v];
    double sum = 0, size = 0;
    for (std::uint32_t b = 0; b < by.n; ++b) sum += by.weight[b], size += std::abs(by.weight[b]);
    EXPECT_NEAR(sum, 1, 1e-12);
    most = std::max(most, size);
    const Vec3 at = by.mean([&](Index node) { return body.rest_position(node); });
    EXPECT_LT((at - surface.rest[v]).norm(), 1e-12);
    EXPECT_LE(((surface.rest[v] - body.rest_position(surface.cell[v])) / 0.002).cwiseAbs().maxCoeff(), 0.5);
  }
  EXPECT_LE(most, 8.0);  // (1/2 + 3/2)^3
}

TEST(SmoothSkin, TurnsAndStretchesWithTheBody) {
  const auto moving = make_body_model(SmoothImage{}.body(), Precision::double_);
  const Surface surface = make_surface(*moving, std::nullopt, 0);
  const Boundary boundary(*moving, 0.02);
  Eigen::Matrix3d A;
  A << 0.9, -0.6, 0.1, 0.5, 1.1, -0.2, 0.05, 0.3, 0.8;
  const Vec3 b(0.01, -0.02, 0.03);
  for (const Index node : moving->body().nodes()) {
    const Vec3 rest = moving->body().rest_position(node);
    moving->place(node, A * rest + b - rest, Vec3::Zero());
  }
  for (std::size_t v = 0; v < surface.n_vertices(); ++v)
    ASSERT_LT((surface.position(v, *moving) - (A * surface.rest[v] + b)).norm(), 1e-14);
  for (std::uint32_t f = 0; f < 100; ++f)
    for (std::size_t c = 0; c < 4; ++c)
      ASSERT_LT((boundary.position(f, c, *moving) - (A * boundary.rest(f, c) + b)).norm(), 1e-14);
}

/// A window of scenery: the rim is held and stays where it was drawn.
TEST(SmoothSkin, OfSceneryMeetsThatOfTissue) {
  const palpate::test::ScratchFolder folder;
  BodySpec spec = SmoothImage{}.spec(folder);
  std::get<VolumeShape>(spec.shape).deformable = {false, {12, 12, 21}, 6};
  const auto moving = make_body_model(build_body(spec, soft_material()), Precision::double_);
  const Surface surface = make_surface(*moving, std::nullopt, 0);
  EXPECT_EQ(defects_of(surface).open_edges, 0);
  EXPECT_LT(surface.n_moving(), surface.n_vertices());
  const double volume = 4.0 / 3 * std::numbers::pi * std::pow(18.3e-3, 3);
  EXPECT_NEAR(volume_inside(surface) / volume, 1, 0.015);  // chords
  std::size_t held = 0;
  for (std::size_t v = 0; v < surface.n_moving(); ++v)
    if (moving->body().inverse_mass[static_cast<std::size_t>(surface.cell[v])] == 0) {
      ++held;
      EXPECT_EQ(surface.bearers[v].n, 1u);
    }
  EXPECT_GT(held, 10u);
}

TEST(SmoothSkin, OfBrighterTissueLiesWhereItBegins) {
  const Body body = SmoothImage{}.body();
  const Surface surface = surface_of(body, 1000 + 100 * 6.1);  // 6.1 mm below the skin
  EXPECT_EQ(defects_of(surface).open_edges, 0);
  double sum = 0;
  for (const Vec3& p : surface.rest) sum += std::abs((1e3 * p - Vec3(0.37, -0.21, 0.55)).norm() - 12.2) / 2;
  EXPECT_LT(sum / static_cast<double>(surface.rest.size()), 0.05);  // of 6 cells
}

/// Whatever part of a cell is outside: what the skin covers is equally bright everywhere.
TEST(SmoothSkin, HasTheColourOfWhatLiesACellBelowIt) {
  Body body = SmoothImage{}.body();
  body.cells->transfer = grey_transfer(1000, 1500);
  const Surface surface = surface_of(body);
  double least = 1e9, most = 0, sum = 0;
  for (const std::uint32_t rgba : surface.rgba) {
    const double brightness = 1000 + 500.0 * (rgba & 0xFFU) / 255;
    least = std::min(least, brightness), most = std::max(most, brightness), sum += brightness;
  }
  EXPECT_NEAR(sum / static_cast<double>(surface.rgba.size()), 1200, 20) << "2 mm below it";
  EXPECT_GT(least, 1170);
  EXPECT_LT(most, 1260);
}

TEST(SmoothSkin, StaysClosedWhereCellsGo) {
  Dice dice(3);
  SmoothImage image;
  image.phi = [ball = ball_mm(19)](const Vec3& p) {
    return ball(p) + std::sin(p.x()) * std::cos(p.y() + p.z());
  };
  image.breaks = true;
  const Body body = image.body();
  ASSERT_TRUE(body.lattice.has_cells);
  const auto hole = [](const Vec3i& c) { return (c - Vec3i(12, 12, 20)).squaredNorm() < 25; };
  const auto slab = [](const Vec3i& c) { return c.x() == 11; };
  std::set<std::array<int, 3>> some;
  for (int n = 0; n < 1400; ++n)
    some.insert({int(dice.between(0, 24)), int(dice.between(0, 24)), int(dice.between(0, 24))});
  const auto holes = [&](const Vec3i& c) { return some.count({c.x(), c.y(), c.z()}) != 0; };
  const Surface before = surface_of(body);
  for (const auto& gone : {std::function<bool(const Vec3i&)>(hole), std::function<bool(const Vec3i&)>(slab),
                           std::function<bool(const Vec3i&)>(holes)}) {
    const Surface after = make_surface(body, without(body, gone), std::nullopt, 0);
    EXPECT_EQ(defects_of(after).open_edges, 0);
    // What was skin stays where it was; what opens is the lattice itself.
    std::set<std::array<double, 3>> known;
    for (const Vec3& p : before.rest) known.insert({p.x(), p.y(), p.z()});
    for (std::size_t v = 0; v < after.n_moving(); ++v) {
      const Vec3& p = after.rest[v];
      const bool on_lattice = (p - body.rest_position(after.cell[v])).norm() == 0;
      EXPECT_TRUE(on_lattice || known.count({p.x(), p.y(), p.z()}) != 0);
      const Vec3 at = after.bearers[v].mean([&](Index node) { return body.rest_position(node); });
      EXPECT_TRUE(after.bearers[v].n <= 1 || (at - p).norm() < 1e-12);
    }
  }
}

/// What tools touch of a body that breaks is what is drawn of it, and moves with what is left.
TEST(SmoothSkin, IsTouchedWhereItIsDrawnWhileCellsBreak) {
  SmoothImage image;
  image.breaks = true;
  const auto moving = make_body_model(image.body(), Precision::double_);
  Boundary boundary(*moving, 0.04, true);
  Dice dice(5);
  const auto nodes = moving->body().nodes();
  for (int round = 0; round < 6; ++round) {
    for (int n = 0; n < 4; ++n) {
      const Index torn = nodes[static_cast<std::size_t>(dice.between(0, double(nodes.size())))];
      moving->place(torn, Vec3(0, 0, 1), Vec3::Zero());
      moving->advance({.dt = 1e-9, .watch = true}, {});
      boundary.follow();
      for (const Index node : nodes) moving->place(node, Vec3::Zero(), Vec3::Zero());
    }
    for (std::uint64_t before = 0; before != boundary.revision();)
      before = boundary.revision(), boundary.update();
    EXPECT_GT(moving->breaks(), 0);
    const auto sorted = [](std::vector<Vec3> all) {
      std::sort(all.begin(), all.end(), [](const Vec3& a, const Vec3& b) {
        return std::array{a.x(), a.y(), a.z()} < std::array{b.x(), b.y(), b.z()};
      });
      return all;
    };
    std::vector<Vec3> drawn, touched;
    const Surface now = make_surface(*moving, std::nullopt, 0);
    for (const auto& f : now.facets)
      drawn.push_back((now.rest[f[0]] + now.rest[f[1]] + now.rest[f[2]] + now.rest[f[3]]) / 4);
    for (std::uint32_t f = 0; f < boundary.most_facets(); ++f)
      if (boundary.exists(f)) touched.push_back(boundary.centroid(f, *moving));
    drawn = sorted(drawn), touched = sorted(touched);
    ASSERT_EQ(drawn.size(), touched.size());
    for (std::size_t n = 0; n < drawn.size(); ++n) ASSERT_LT((drawn[n] - touched[n]).norm(), 1e-9);
    // As one piece, whatever its vertices were carried by before.
    Eigen::Matrix3d A;
    A << 0.9, -0.6, 0.1, 0.5, 1.1, -0.2, 0.05, 0.3, 0.8;
    for (const Index node : nodes) {
      const Vec3 rest = moving->body().rest_position(node);
      moving->place(node, A * rest - rest, Vec3::Zero());
    }
    for (std::uint32_t f = 0; f < boundary.most_facets(); ++f)
      for (std::size_t c = 0; boundary.exists(f) && c < 4; ++c)
        EXPECT_LT((boundary.position(f, c, *moving) - A * boundary.rest(f, c)).norm(), 1e-13);
    for (const Index node : nodes) moving->place(node, Vec3::Zero(), Vec3::Zero());
  }
}

}  // namespace
}  // namespace palpate::physics
