// A picture of which only what changed is drawn is, pixel by pixel, the picture of which all is.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "common/scene/body_spec.h"
#include "common/scene/device_spec.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "common/scene/surroundings_spec.h"
#include "common/scene/tool_spec.h"
#include "render_node/picture.h"
#include "tests/unit/render_node/render_support.h"

namespace palpate::render {
namespace {

constexpr double side = 0.1;

/// Two pictures of the same messages.
class Pair {
 public:
  Pair(const Scene& scene, const test::VoxelSurface& surface, Edges edges)
      : surface_(surface), kept_(scene, edges), whole_(scene, edges) {
    for (Picture* picture : {&kept_, &whole_}) test::show(*picture, surface_);
  }
  template <class M>
  void take(const M& message) {
    kept_.take(message);
    whole_.take(message);
  }
  /// Pushes what lies near `at` by `by`.
  void dent(const Eigen::Vector3f& at, float radius, const Eigen::Vector3f& by) {
    const std::uint32_t n =
        static_cast<std::uint32_t>((surface_.position.size() + max_block_vertices - 1) / max_block_vertices);
    for (std::uint32_t b = 0; b < n; ++b) {
      auto block = test::block_of(surface_, 0, 1, b);
      bool any = false;
      for (std::uint32_t v = 0; v < block.n_vertices; ++v) {
        Array3f& p = surface_.position[block.first_vertex + v];
        if ((Eigen::Vector3f(p.data()) - at).norm() > radius) continue;
        any = true;
        for (std::size_t k = 0; k < 3; ++k) p[k] += by[static_cast<Eigen::Index>(k)];
        block.position[v] = p;
      }
      if (any) take(block);
    }
  }
  void point(std::uint32_t tool, const std::array<double, 3>& tip, double t, double newton) {
    auto trace = test::trace_at(tip, t, newton);
    trace.tool = tool;
    take(trace);
    ToolWrench wrench;
    wrench.tool = tool;
    wrench.force = {0, -newton, 0.3 * newton};
    wrench.n_contacts = newton > 0 ? 3 : 0;
    wrench.q_WT = {1, 0, 0, 0};
    wrench.t = t;
    take(wrench);
  }
  /// @return pixels that differ
  int draw(double t) {
    whole_.draw_whole();
    whole_.draw(t);
    kept_.draw(t);
    return test::pixels_that_differ(kept_.image(), whole_.image());
  }
  double drawn_share() const { return kept_.drawn_share(); }
  const Image& image() const { return kept_.image(); }

 private:
  test::VoxelSurface surface_;
  Picture kept_, whole_;
};

struct Session {
  const char* name;
  std::function<void(Scene&)> change;
  int cells = 12;      // along a side of the cube
  bool wired = false;  // lines are drawn whole or not at all
};

class KeptPicture : public testing::TestWithParam<Session> {};

/// Dents anywhere, tools that come, press, leave and stand still, pictures of nothing new.
TEST_P(KeptPicture, IsThatOfWhichAllIsDrawn) {
  Scene scene = test::small_scene();
  scene.render->camera.yaw = 0.4;
  scene.render->camera.pitch = 0.3;
  DeviceSpec other = scene.devices[0];
  other.name = "other";
  scene.devices.push_back(other);
  ToolSpec second = scene.tools[0];
  second.name = "second";
  second.device = "other";
  second.radius = 0.003;
  scene.tools.push_back(second);
  GetParam().change(scene);
  const auto cube = test::cube_surface(GetParam().cells, side, 0xff96b4e6U);
  std::mt19937 random(7);
  const auto between = [&random](double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(random);
  };
  for (const Edges edges : {Edges::plain, Edges::smooth}) {
    Pair pair(scene, cube, edges);
    int changed = 0, parts = 0;
    Image before;
    Eigen::Vector3f pulled_at = Eigen::Vector3f::Zero(), pulled_by = pulled_at;
    for (int n = 0; n < 24; ++n) {
      const double t = 0.02 * n;
      const double h = side / 2;
      if (n % 4 == 0) {  // so far that it leaves where it was
        pulled_at = Eigen::Vector3d(between(-h, h), -h, between(-h, h)).cast<float>();
        pulled_by = Eigen::Vector3d(between(-0.04, 0.04), -0.02, between(-0.04, 0.04)).cast<float>();
        pair.dent(pulled_at, 0.015F, pulled_by);
      } else if (n % 4 == 2) {  // and back
        pair.dent(pulled_at + pulled_by, 0.0151F, -pulled_by);
      } else if (n % 3 != 2) {
        pair.dent(
            Eigen::Vector3d(between(-h, h), between(-h, h), between(-h, h)).cast<float>(), 0.015F,
            Eigen::Vector3d(between(-4e-3, 4e-3), between(-4e-3, 4e-3), between(-4e-3, 4e-3)).cast<float>());
      }
      if (n % 2 == 1)
        pair.point(n % 4 == 1 ? 0 : 1, {between(-h, h), between(-1.6 * h, -h), between(-h, h)}, t,
                   std::max(0.0, between(-0.5, 1)));
      ASSERT_EQ(pair.draw(t), 0) << GetParam().name << ", picture " << n;
      if (n > 0) changed += test::pixels_that_differ(before, pair.image()) > 0 ? 1 : 0;
      parts += pair.drawn_share() < 0.9 ? 1 : 0;
      before = pair.image();
    }
    EXPECT_GT(changed, 5) << GetParam().name << ": there was something to see";
    EXPECT_EQ(parts > 8, !GetParam().wired) << parts << " of them in part: " << GetParam().name;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Sessions, KeptPicture,
    testing::Values(Session{"plain", [](Scene&) {}}, Session{"dense", [](Scene&) {}, 60},
                    Session{"wire", [](Scene& s) { s.render->show_wire = true; }, 12, true},
                    Session{"veil", [](Scene& s) { s.render->opacity = 0.5; }},
                    Session{"coloured", [](Scene& s) { s.render->colour = ColourKind::displacement; }},
                    Session{"panels", [](Scene& s) { s.render->show_panels = true; }},
                    Session{"walled",
                            [](Scene& s) {
                              s.floor = FloorSpec{-0.06};
                              s.walls.push_back({Vec3(0.08, 0, 0), -Vec3::UnitX()});
                            }},
                    Session{"near", [](Scene& s) { s.render->camera.distance = 0.12; }, 60}),
    [](const auto& of) { return std::string(of.param.name); });

/// An element and a mass that no facet shows are in no chunk.
TEST(KeptPictures, FollowWhatNoFacetShows) {
  for (const bool element : {true, false})
    for (const Edges edges : {Edges::plain, Edges::smooth}) {
      auto surface = test::cube_surface(12, side, 0xff96b4e6U);
      const auto n = static_cast<std::uint32_t>(surface.position.size());
      surface.position.insert(surface.position.end(), {{-0.03F, -0.08F, 0}, {0.03F, -0.08F, 0.01F}});
      surface.corners.push_back(element ? std::array{n, n + 1, n + 1, n + 1} : std::array{n, n, n, n});
      surface.rgba.push_back(0xff20c020U);
      Pair pair(test::small_scene(), surface, edges);
      ASSERT_EQ(pair.draw(0), 0);
      for (int k = 1; k < 5; ++k) {
        const Image before = pair.image();
        pair.dent({-0.03F, -0.08F, 0.01F * static_cast<float>(k - 1)}, 0.005F, {0, 0, 0.01F});
        ASSERT_EQ(pair.draw(0.1 * k), 0) << k;
        EXPECT_GT(test::pixels_that_differ(before, pair.image()), 10) << "it moved";
      }
    }
}

TEST(KeptPictures, DrawNothingWhereNothingChanged) {
  const Scene scene = test::small_scene();
  Picture picture(scene);
  test::show(picture, test::cube_surface(12, side, 0xff96b4e6U));
  picture.draw(0);
  EXPECT_EQ(picture.drawn_share(), 1);
  picture.draw(0.1);
  EXPECT_EQ(picture.drawn_share(), 0);
}

}  // namespace
}  // namespace palpate::render
