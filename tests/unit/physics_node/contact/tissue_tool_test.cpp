// Tissue that the hand's motion presses: it bears what spring and damper say, whenever messages come, and lets go when the hand does.

#include "physics_node/contact/tissue_tool.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/error/error.h"
#include "common/math/growing_contact.h"
#include "common/scene/load_scene.h"
#include "common/scene/scene.h"
#include "tests/support/physics/palpated_slab.h"
#include "tests/support/physics/palpation.h"

namespace palpate::physics::test {
namespace {

/// Where the told surface is.
Vec3 surface_told(const TouchedTissue& told) {
  const Vec3 n = vec(told.normal), force = vec(told.force), along = n.dot(force) * n;
  const double give = GrowingContact{told.residual, told.growth}.give(-n.dot(force));
  Vec3 at = vec(told.rest) - give * n + told.residual_across * (force - along);
  for (std::uint32_t i = 0; i < told.n_modes; ++i) at += told.modes[i].q * vec(told.modes[i].psi);
  return at;
}

TEST(TissueTool, BearsWhatTheSpringOfTheHandPressesWith) {
  for (const char* model : {"fem", "springs"}) {
    Session session(palpated_slab(1000, model));
    const auto held = [](double t) { return palpation(std::min(t, 0.15)); };
    for (std::uint64_t n = 1; n <= 600; ++n) session.to(n, held);
    const TouchedTissue& told = session.patch.tissues[0];
    ASSERT_EQ(session.patch.n_tissues, 1u);
    EXPECT_EQ(told.sample, 600u);
    const double force = pressed(told);
    EXPECT_GT(force, 0.1) << model;
    EXPECT_NEAR(session.borne().z(), force, 1e-9 + 1e-3 * force) << "on the tool, out of the tissue";
    EXPECT_NEAR(total(forces_of_tool(session.world)).z(), -force, 1e-6 + 1e-3 * force);
    const double depth = vec(told.normal).dot(surface_told(told) - held(1));
    EXPECT_NEAR(force, 500 * depth, 0.005 * force) << "K (x - z), at rest";
    EXPECT_EQ(told.n_modes, std::string(model) == "fem" ? 9u : 0u);
  }
}

/// In the hand's own time: the same force at the same sample, however seldom physics steps.
TEST(TissueTool, BearsTheSameForceAtASampleAtAnyRate) {
  Session often(palpated_slab(1000)), seldom(palpated_slab(20));
  double off2 = 0, all2 = 0;
  for (std::uint64_t n = 1; n <= 650; ++n) {
    const double force = pressed(often.to(n));
    if (n % 50 != 0 || n < 100) continue;
    const double other = pressed(seldom.to(n));
    off2 += (force - other) * (force - other), all2 += force * force;
  }
  EXPECT_GT(all2, 0.1);
  EXPECT_LT(std::sqrt(off2 / all2), 0.03);
}

/// A tap whose way in falls into one frame, on tissue that has slept until then: it must not stand until the frame ends.
TEST(TissueTool, BearsTheSameForceInATapOnTissueThatSleeps) {
  const auto tap = [](double t) {
    const double s = std::clamp((t - 0.205) / 0.1, 0.0, 1.0);
    return Vec3(0.0005, 0.0005, slab_top + 3e-3 - 5e-3 * (0.5 - 0.5 * std::cos(2 * M_PI * s)));
  };
  for (const char* model : {"fem", "springs"}) {
    Session often(palpated_slab(1000, model)), seldom(palpated_slab(20, model));
    for (std::uint64_t n = 1; n < 250; ++n) often.to(n, tap);
    for (std::uint64_t n = 50; n < 250; n += 50) seldom.to(n, tap);
    const double force = pressed(often.to(250, tap)), other = pressed(seldom.to(250, tap));
    EXPECT_GT(force, 0.1) << model;
    EXPECT_NEAR(other, force, 0.03 * force) << model;
  }
}

/// From 20 mm above within a frame of 50 ms, 0.9 m/s at most.
TEST(TissueTool, MeetsTissueFromFarInOneFrame) {
  const auto blow = [](double t) {
    const double s = std::clamp((t - 0.205) / 0.04, 0.0, 1.0);
    return Vec3(0.0005, 0.0005, slab_top + 20e-3 - 22e-3 * (0.5 - 0.5 * std::cos(M_PI * s)));
  };
  Session often(palpated_slab(1000)), seldom(palpated_slab(20));
  for (std::uint64_t n = 1; n < 300; ++n) often.to(n, blow);
  for (std::uint64_t n = 50; n < 300; n += 50) seldom.to(n, blow);
  EXPECT_GT(pressed(seldom.patch.tissues[0]), 0.1) << "at the end of the frame in which it came";
  const double force = pressed(often.to(300, blow)), other = pressed(seldom.to(300, blow));
  EXPECT_GT(force, 0.1);
  EXPECT_NEAR(other, force, 0.03 * force);
}

TEST(TissueTool, BearsNothingFromTheFirstSampleThatIsClear) {
  Session session(palpated_slab(1000));
  std::uint64_t n = 1;
  double most = 0;
  for (; n < 650 || palpation(1e-3 * static_cast<double>(n)).z() < slab_top + 1e-4; ++n)
    most = std::max<double>(most, pressed(session.to(n)));
  EXPECT_GT(most, 0.1);
  for (const std::uint64_t end = n + 200; n < end; ++n) {
    session.to(n);
    ASSERT_EQ(session.borne(), Vec3(Vec3::Zero())) << n;
  }
}

/// From far above, where no face is listed, to contact: what is told is a number all the way.
TEST(TissueTool, TellsOfTissueOnlyWhereItKnowsWhereItIs) {
  Session session(palpated_slab(1000));
  int told = 0;
  for (std::uint64_t n = 1; n <= 400; ++n) {
    const TouchedTissue& tissue =
        session.to(n, [](double t) { return Vec3(0, 0, slab_top + 0.03 - 0.08 * t); });
    if (session.patch.n_tissues == 0) continue;
    ++told;
    ASSERT_TRUE(vec(tissue.rest).allFinite()) << n;
    if (pressed(tissue) > 0) continue;
    EXPECT_NEAR(surface_told(tissue).z(), slab_top, 3e-4) << n;
  }
  EXPECT_GT(told, 50);
}

/// Of all nodal forces about a point [N m].
Vec3 moment_on_tissue(const World& world, const Vec3& about) {
  Vec3 moment = Vec3::Zero();
  for (const NodalForce& nodal : forces_of_tool(world))
    moment += (world.body(0).position(nodal.cell) - about).cross(nodal.force);
  return moment;
}

/// Whatever its shape, tissue bears the force of the hand's spring and its moment: that at the end of the told arm.
TEST(TissueTool, PressesWithTheShapeThatAToolHas) {
  struct Pressed {
    const char* words;
    Vec3 tip;    // above the middle of what comes to bear [m]
    double arm;  // sideways [m]
  };
  for (const Pressed& shape :
       {Pressed{"shape = \"cylinder\"\nradius_mm = 6\nlength_mm = 30", Vec3::Zero(), 0},
        Pressed{"shape = \"cone\"\nradius_mm = 12\nlength_mm = 12", Vec3::Zero(), 0},
        Pressed{"shape = \"box\"\nsize_mm = [16, 12, 5]", Vec3::Zero(), 0},
        Pressed{"shape = \"stick\"\nradius_mm = 3\nlength_mm = 60\ntheta_deg = [0, -90, 0]",
                Vec3(-0.055, 0, 0.003), 0.03}}) {
    Session session(palpated_by(shape.words));
    const auto held = [&](double t) { return Vec3(palpation(std::min(t, 0.15)) + shape.tip); };
    for (std::uint64_t n = 1; n <= 350; ++n) session.to(n, held);
    const TouchedTissue& told = session.patch.tissues[0];
    ASSERT_EQ(session.patch.n_tissues, 1u) << shape.words;
    const double force = pressed(told);
    EXPECT_GT(force, 0.1) << shape.words;
    const Vec3 on_tissue = total(forces_of_tool(session.world)), tip = vec(told.rest),
               lies = surface_told(told);
    EXPECT_NEAR((on_tissue - vec(told.force)).norm(), 0, 2e-3 * force) << shape.words;
    const Vec3 moment = moment_on_tissue(session.world, lies), by_arm = vec(told.arm).cross(vec(told.force));
    EXPECT_NEAR((moment - by_arm).norm(), 0, force * 1e-3) << shape.words << " within 1 mm of the arm";
    EXPECT_GE(std::hypot(told.arm[0], told.arm[1]), shape.arm) << shape.words;
    EXPECT_NEAR(force, 500 * vec(told.normal).dot(lies - held(1)), 0.01 * force) << "K (x - z)";
    EXPECT_TRUE(tip.allFinite());
  }
}

/// A stick that lies on the block and turns about its tip goes deeper at its other end.
TEST(TissueTool, TurnsWithTheHandle) {
  Session session(palpated_by("shape = \"stick\"\nradius_mm = 3\nlength_mm = 60\ntheta_deg = [0, -90, 0]"));
  const Vec3 tip(-0.055, 0.0005, slab_top + 0.0035);
  double before = -1;
  for (std::uint64_t n = 1; n <= 400; ++n) {
    std::optional<ToolState> hand = recorded_hand([&](double) { return tip; }, n);
    const double angle = 0.06 * std::clamp((static_cast<double>(n) - 50) / 200, 0.0, 1.0);
    const Eigen::Quaterniond q(Eigen::AngleAxisd(angle, Vec3::UnitY()));
    hand->q_WT = {q.w(), q.x(), q.y(), q.z()};
    session.world.frame(std::span(&hand, 1));
    session.world.tool(0).write_patch(session.patch, 1, 0);
    if (n == 50) before = session.borne().norm();
  }
  EXPECT_EQ(before, 0);
  EXPECT_GT(session.borne().z(), 0.1);
  EXPECT_GT(vec(session.patch.tissues[0].arm).x(), 0.03);
}

/// Led aside, the tip sticks until Coulomb's cone is reached, and then slides; tissue bears what the spring pulls with.
TEST(TissueTool, RubsWithCoulombsFriction) {
  for (const double friction : {0.0, 0.2, 2.0}) {
    Recipe recipe = palpated_slab(1000);
    const std::string shape = "shape = \"point\"";
    recipe.world.insert(recipe.world.find(shape) + shape.size(), "\nfriction = " + std::to_string(friction));
    Session session(recipe);
    constexpr double aside = 2e-3;
    const auto path = [&](double t) {
      return Vec3(palpation(std::min(t, 0.15)) + Vec3(aside * std::clamp((t - 0.3) / 0.2, 0.0, 1.0), 0, 0));
    };
    for (std::uint64_t n = 1; n <= 900; ++n) session.to(n, path);
    const TouchedTissue& told = session.patch.tissues[0];
    const Vec3 force = vec(told.force), on_tissue = total(forces_of_tool(session.world));
    EXPECT_NEAR((force - on_tissue).norm(), 0, 1e-6 + 2e-3 * force.norm());
    EXPECT_NEAR((force + session.borne()).norm(), 0, 1e-9);
    if (friction < 1) {
      EXPECT_NEAR(force.x(), friction * pressed(told), 1e-3 * pressed(told)) << "it has slid";
    } else {
      EXPECT_GT(force.x(), 0.2 * pressed(told));
    }
    EXPECT_LE(std::hypot(force.x(), force.y()), friction * pressed(told) + 1e-9);
    const Vec3 spring = 500 * (path(1) - surface_told(told));
    EXPECT_NEAR((spring - force).x(), 0, 0.01 * pressed(told)) << "K (x - a), at rest: " << friction;
  }
}

/// A tip that is in the tissue without having come in bears nothing until it has been outside: what it would throw out is no touch.
TEST(TissueTool, BeginsOutsideOnly) {
  Session session(palpated_slab(1000));
  const auto path = [](double t) {
    return Vec3(0.0005, 0.0005, slab_top - 0.003 * std::abs(std::cos(M_PI * t / 0.4)));
  };
  bool came_out = false, touched = false;
  for (std::uint64_t n = 1; n <= 400; ++n) {
    const TouchedTissue& told = session.to(n, path);
    const double t = 1e-3 * static_cast<double>(n);
    if (t > 0.17) came_out = true;
    if (!came_out) {
      ASSERT_EQ(session.patch.n_tissues, 0u) << n;
      ASSERT_EQ(session.borne(), Vec3(Vec3::Zero())) << n;
    }
    touched = touched || (session.patch.n_tissues > 0 && pressed(told) > 0.1);
  }
  EXPECT_TRUE(touched) << "the second time it comes from outside";
}

/// What nothing holds has no modes to tell: it lies on things that they do not know.
TEST(TissueTool, TellsNoModesOfAFreeBody) {
  Recipe recipe = palpated_slab(1000);
  recipe.body.replace(recipe.body.find("fixed = [\"-z\"]"), 14, "");
  Session session(recipe);
  for (std::uint64_t n = 1; n <= 60; ++n) session.to(n);
  ASSERT_EQ(session.patch.n_tissues, 1u);
  EXPECT_EQ(session.patch.tissues[0].n_modes, 0u);
}

/// Told modes rest where the tip's force holds them, whatever else loads the body: a copy that is stepped on stands.
TEST(TissueTool, TellsModesThatStandUnderWeight) {
  Recipe recipe = palpated_slab(1000);
  recipe.gravity = "[0, 0, -9.81]";
  Session session(recipe);
  const auto held = [](double t) { return palpation(std::min(t, 0.15)); };
  for (std::uint64_t n = 1; n <= 900; ++n) session.to(n, held);
  const TouchedTissue& told = session.patch.tissues[0];
  ASSERT_GT(told.n_modes, 0u);
  ASSERT_GT(pressed(told), 0.1);
  double pushes = 0, off = 0;
  for (std::uint32_t i = 0; i < told.n_modes; ++i) {
    const double by_tip = vec(told.modes[i].psi).dot(vec(told.force));
    pushes = std::max(pushes, std::abs(by_tip));
    off = std::max(off, std::abs(told.modes[i].stiffness * told.modes[i].q - by_tip));
  }
  EXPECT_LT(off, 0.02 * pushes);
}

/// Over a wall of 4 mm above a cavity the tip is felt where it touches: the far side of the wall is not what it is pressed on.
TEST(TissueTool, TouchesAThinWallWhereItIs) {
  for (const char* model : {"fem", "springs"}) {
    World world(parse_scene(std::string(R"(
title = "wall"
gravity_m_per_s2 = [0, 0, 0]
[material.soft]
density_kg_per_m3 = 1000
modulus_kPa = 20
viscosity_Pa_s = 5
[[tool]]
name = "tip"
radius_mm = 5
force_model = "tissue"
device = "hand"
[device.hand]
driver = "simulated"
waypoints = [[0, 0, 0, 50], [1, 0, 0, 40]]
[[body]]
name = "block"
lattice = "voxel"
spacing_mm = 2
shape = "box"
size_mm = [40, 40, 24]
at_mm = [0, 0, -12]
fixed = ["-z"]
material = "soft"
model = ")") + model + "\"\n[[body.cavity]]\nbox_min_mm = [-12, -12, -18]\nbox_max_mm = [12, 12, -4]\n",
                            "wall"));
    const auto path = [](double t) { return Vec3(0, 0, 2e-3 - 1e-2 * t); };
    double first = 1;
    for (std::uint64_t n = 1; n <= 260 && first == 1; ++n) {
      std::optional<ToolState> hand = recorded_hand(path, n);
      world.frame(std::span(&hand, 1));
      if (world.tool(0).borne().norm() > 1e-4) first = hand->p_WT[2];
    }
    EXPECT_LE(first, 0) << model;
    EXPECT_GE(first, -2e-4) << model;
  }
}

TEST(TissueTool, LetsGoOfTissueWhereTheHandIsSilent) {
  Session session(palpated_slab(1000));
  for (std::uint64_t n = 1; n <= 300; ++n) session.to(n);
  double before = session.borne().z();
  ASSERT_GT(before, 0.1);
  run(session.world, std::nullopt, 50);
  EXPECT_LT(session.borne().z(), before) << "a quarter is gone";
  EXPECT_GT(session.borne().z(), 0.3 * before);
  run(session.world, std::nullopt, 160);
  EXPECT_EQ(session.borne().z(), 0);
}

/// A hand whose forces are off presses nothing, nor one that feels none.
TEST(TissueTool, IsNotPressedByAHandThatFeelsNothing) {
  for (const bool engaged : {false, true}) {
    World world(scene_of(palpated_slab(1000)));
    for (std::uint64_t n = 1; n <= 300; ++n) {
      std::optional<ToolState> hand = recorded_hand(palpation, n);
      hand->engaged = engaged ? 1 : 0;
      if (engaged) hand->force_limit = 0;
      world.frame(std::span(&hand, 1));
      ASSERT_TRUE(forces_of_tool(world).empty());
    }
  }
}

TEST(TissueTool, RefusesCellsThatAreTooCoarse) {
  Recipe recipe = palpated_slab(1000);
  recipe.spacing_mm = 12;
  EXPECT_THROW(World{scene_of(recipe)}, InputError);
}

TEST(TissueTool, BeginsAnewAfterAReset) {
  Session session(palpated_slab(1000));
  for (std::uint64_t n = 1; n <= 200; ++n) session.to(n);
  session.world.reset();
  EXPECT_EQ(session.borne(), Vec3(Vec3::Zero()));
  EXPECT_EQ(pressed(session.to(1)), 0) << "from outside again";
}

}  // namespace
}  // namespace palpate::physics::test
