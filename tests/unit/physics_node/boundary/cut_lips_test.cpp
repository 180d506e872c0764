// The lips of a cut through cells under a smooth skin: they lie on the blade's path, drawn and felt, and no gap is between them and the
// skin.

#include "physics_node/boundary/cut_lips.h"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <set>

#include "physics_node/boundary/boundary.h"
#include "physics_node/step/body_model.h"
#include "tests/support/physics/smooth_image.h"

namespace palpate::physics {
namespace {

using namespace test;

constexpr double ball_radius = 0.0183, edge = 0.002;  // [m]
const Vec3 middle_of_ball(0.37e-3, -0.21e-3, 0.55e-3);

std::array<float, 3> normal_of(const Vec3& n) {
  return {static_cast<float>(n.x()), static_cast<float>(n.y()), static_cast<float>(n.z())};
}

struct CutBall {
  explicit CutBall(BorderCells border = BorderCells::whole) {
    const palpate::test::ScratchFolder folder;
    SmoothImage image;
    image.border = border;
    const BodySpec spec = image.spec(folder);
    MaterialSpec material = soft_material();
    material.viscosity = 1;
    material.cut_toughness = 190;
    Body body = build_body(spec, material);
    material.name = spec.material;
    make_ready_for_cuts(spec, {material}, body);
    moving = make_body_model(std::move(body), Precision::double_);
    surface = std::make_unique<Boundary>(*moving, 0.008, true);
  }
  Vec3 centre_of(Index c) const {
    const Body& body = moving->body();
    return body.lattice.rest_position(c) + 0.5 * body.lattice.step;
  }
  /// By a blade in the plane n . x = d that goes as far as `hit` says.
  void cut(const Vec3& n, double d, const std::function<bool(const Vec3&)>& hit) {
    const CellNet& net = *moving->body().cell_net();
    std::vector<EdgeGone> faces;
    for (const Index c : net.cells())
      for (std::size_t f = 1; f < CellNet::n_faces; f += 2) {
        const Index other = net.beyond(c, f);
        if (other == CellNet::none) continue;
        const double a = n.dot(centre_of(c)) - d, b = n.dot(centre_of(other)) - d;
        if ((a >= 0) == (b >= 0)) continue;
        const double share = a / (a - b);
        if (hit(centre_of(c) + share * (centre_of(other) - centre_of(c))))
          faces.push_back({c, other, {static_cast<float>(share), normal_of(n)}});
      }
    moving->cut(faces);
    surface->follow();
    surface->update();
  }
  /// All that there are, touchable or not.
  std::vector<std::uint32_t> facets() const {
    std::vector<std::uint32_t> all;
    for (std::uint32_t f = 0; f < surface->most_facets(); ++f)
      if (surface->exists(f)) all.push_back(f);
    return all;
  }
  Surface drawn() const { return make_surface(*moving, std::nullopt, 0xff8080ffU); }

  std::unique_ptr<BodyModel> moving;
  std::unique_ptr<Boundary> surface;
};

bool everywhere(const Vec3&) { return true; }

const Vec3 normals[] = {Vec3(0, 1, 0), Vec3(0.2, 1, 0.1).normalized(), Vec3(1, 0.8, 0.6).normalized()};

/// Facets of the lips: those whose plane is nearly the blade's and that lie near to it.
struct Lips {
  double area = 0, off = 0;  // of both [m^2], rms of their corners off the plane [m]
};
template <class Each>
Lips lips_near(const Vec3& n, double d, const Each& each_facet) {
  Lips lips;
  double sum = 0, count = 0;
  each_facet([&](const std::array<Vec3, 4>& x) {
    const Vec3 area = 0.5 * (x[2] - x[0]).cross(x[3] - x[1]);
    const Vec3 middle = 0.25 * (x[0] + x[1] + x[2] + x[3]);
    if (std::abs(n.dot(middle) - d) > 0.3 * edge || std::abs(area.normalized().dot(n)) < 0.8) return;
    if ((middle - middle_of_ball).norm() > ball_radius - 0.25 * edge) return;
    lips.area += std::abs(area.dot(n));
    for (const Vec3& p : x) sum += (n.dot(p) - d) * (n.dot(p) - d), ++count;
  });
  lips.off = std::sqrt(sum / count);
  return lips;
}

TEST(CutLips, LieOnThePlaneOfTheBladeDrawnAndFelt) {
  for (const Vec3& n : normals) {
    const double d = n.dot(middle_of_ball) + 0.0007;
    CutBall ball;
    ball.cut(n, d, everywhere);
    const double section = std::numbers::pi * (ball_radius * ball_radius - 0.0007 * 0.0007);
    const Surface drawn = ball.drawn();
    const Lips seen = lips_near(n, d, [&](const auto& take) {
      for (const auto& f : drawn.facets)
        take({drawn.rest[f[0]], drawn.rest[f[1]], drawn.rest[f[2]], drawn.rest[f[3]]});
    });
    EXPECT_LT(seen.off, 0.1 * edge) << n.transpose();
    EXPECT_NEAR(seen.area, 2 * section, 0.06 * 2 * section) << n.transpose();
    const Lips felt = lips_near(n, d, [&](const auto& take) {
      for (const std::uint32_t f : ball.facets())
        take({ball.surface->position(f, 0, *ball.moving), ball.surface->position(f, 1, *ball.moving),
              ball.surface->position(f, 2, *ball.moving), ball.surface->position(f, 3, *ball.moving)});
    });
    EXPECT_NEAR(felt.off, seen.off, 1e-6) << n.transpose();
    EXPECT_NEAR(felt.area, seen.area, 1e-3 * seen.area) << n.transpose();
  }
}

TEST(CutLips, LeaveNoGap) {
  for (const BorderCells border : {BorderCells::whole, BorderCells::filled})
    for (const Vec3& n : normals)
      for (const bool half : {false, true}) {
        CutBall ball(border);
        ball.cut(n, n.dot(middle_of_ball) + 0.0007,
                 [&](const Vec3& p) { return !half || p.dot(n.unitOrthogonal()) > 0.003; });
        ASSERT_GT(ball.moving->breaks(), 50);
        EXPECT_EQ(defects_of(ball.drawn()).open_edges, 0) << n.transpose() << half;
        // Felt: the vector area of what is closed is none, however it is bent.
        const Body& body = ball.moving->body();
        body.each_node([&](Index node) {
          const Vec3 x = body.rest_position(node);
          const bool copy = body.origin(node) != node;
          ball.moving->place(node, Vec3(0.02 * x.y(), copy ? 0.0006 : 0.01 * x.z(), copy ? 0.0004 : 0.0),
                             Vec3::Zero());
        });
        Vec3 area = Vec3::Zero();
        for (const std::uint32_t f : ball.facets())
          area += ball.surface->centroid_and_area(f, *ball.moving).area;
        EXPECT_LT(area.norm(), 1e-12) << n.transpose() << half;
      }
}

/// Lips that lie on each other are no gap to a tool, and bear no tip; those that are apart are and do.
TEST(CutLips, AreTouchedWhereTheyAreApart) {
  const Vec3 n(0, 1, 0);
  CutBall ball;
  const auto near = [&] {
    std::vector<std::uint32_t> facets;
    ball.surface->facets_near(middle_of_ball, 0.5 * ball_radius, *ball.moving, facets);
    return facets.size();
  };
  EXPECT_EQ(near(), 0U);
  ball.cut(n, middle_of_ball.y() + 0.0007, everywhere);
  EXPECT_EQ(near(), 0U);
  const auto pull = [&](double way) {
    const CellNet& net = *ball.moving->body().cell_net();
    for (const Index c : net.cells())
      if (ball.centre_of(c).y() > middle_of_ball.y() + 0.0007)
        for (const Index node : net.corners(c)) ball.moving->place(node, Vec3(0, way, 0), Vec3::Zero());
  };
  pull(0.0004);
  EXPECT_EQ(near(), 0U);
  pull(-0.001);
  EXPECT_EQ(near(), 0U) << "through each other";
  pull(0.001);
  EXPECT_GT(near(), 60U);
}

/// Both lips lie on each other while nothing pulls, and each goes with its own half.
TEST(CutLips, GoWithTheirOwnHalf) {
  const Vec3 n(0, 1, 0);
  CutBall ball;
  ball.cut(n, middle_of_ball.y() + 0.0007, everywhere);
  const CellNet& net = *ball.moving->body().cell_net();
  std::set<Index> upper;
  for (const Index c : net.cells())
    if (ball.centre_of(c).y() > middle_of_ball.y() + 0.0007)
      for (const Index node : net.corners(c)) upper.insert(node);
  ball.moving->body().each_node([&](Index node) {
    ball.moving->place(node, Vec3(0, upper.contains(node) ? 0.005 : 0, 0), Vec3::Zero());
  });
  const Surface drawn = ball.drawn();
  int up = 0, down = 0;
  for (std::size_t v = 0; v < drawn.n_moving(); ++v) {
    const double way = (drawn.position(v, *ball.moving) - drawn.rest[v]).y();
    EXPECT_TRUE(std::abs(way) < 1e-12 || std::abs(way - 0.005) < 1e-12) << way;
    (way > 0.0025 ? up : down)++;
  }
  EXPECT_GT(up, 300);
  EXPECT_GT(down, 300);
}

TEST(CutLips, GoBackWithAReset) {
  CutBall ball;
  const Surface whole = ball.drawn();
  ball.cut(normals[2], normals[2].dot(middle_of_ball), everywhere);
  EXPECT_GT(ball.surface->n_open(), 100U);
  ball.moving->reset();
  ball.surface->follow();
  ball.surface->update();
  EXPECT_EQ(ball.surface->n_open(), 0U);
  const Surface again = ball.drawn();
  EXPECT_EQ(again.facets, whole.facets);
  EXPECT_EQ(again.rest, whole.rest);
}

}  // namespace
}  // namespace palpate::physics
