#include "haptic_node/contact/tangent_wrench.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/message/vec3.h"

namespace palpate::haptic {
namespace {

constexpr double dt = 1e-3, K_hand = 800;

/// A spring of 200 N/m along z and of 0.5 N m/rad about y that pushes with 0.4 N and 0.02 N m at the origin.
ToolWrench sample_wrench() {
  ToolWrench wrench;
  wrench.tick = 1;
  wrench.force = {0, 0, 0.4};
  wrench.moment = {0, 0.02, 0};
  wrench.stiffness[14] = 200;
  wrench.stiffness[28] = 0.5;
  return wrench;
}

HandMotion hand_at(const Vec3& x, double about_y = 0) {
  HandMotion hand;
  hand.x = x;
  hand.q = Eigen::AngleAxisd(about_y, Vec3::UnitY());
  return hand;
}

ContactResult rest(TangentWrench& spring, const HandMotion& hand, int ticks) {
  ContactResult felt;
  for (int i = 0; i < ticks; ++i) felt = spring.tick(hand, dt);
  return felt;
}

TEST(TangentWrench, FeelsTheAnswerAtItsPose) {
  TangentWrench spring(K_hand, 1);
  spring.take(sample_wrench(), 0.01);
  const ContactResult felt = rest(spring, hand_at(Vec3::Zero()), 200);
  EXPECT_LT((felt.force - Vec3(0, 0, 0.4)).norm(), 1e-9);
  EXPECT_LT((felt.torque - Vec3(0, 0.02, 0)).norm(), 1e-9);
  EXPECT_NEAR(felt.stored, 0.5 * (0.4 * 0.4 / 200 + 0.02 * 0.02 / 0.5), 1e-9);
}

TEST(TangentWrench, FollowsTheHandByItsStiffness) {
  TangentWrench spring(K_hand, 0);
  spring.take(sample_wrench(), 0.01);
  rest(spring, hand_at(Vec3::Zero()), 200);
  const ContactResult pressed = spring.tick(hand_at({0.003, -0.002, -0.0005}), dt);
  EXPECT_NEAR(pressed.force.z(), 0.4 + 200 * 0.0005, 1e-9);
  EXPECT_LT(pressed.force.head<2>().norm(), 1e-12) << "sideways there is no spring";
  const ContactResult turned = spring.tick(hand_at({0.003, -0.002, -0.0005}, -0.01), dt);
  EXPECT_NEAR(turned.torque.y(), 0.02 + 0.5 * 0.01, 1e-9);
  EXPECT_NEAR(turned.force.z(), 0.5, 1e-9);
}

TEST(TangentWrench, TellsTheMomentAboutTheTip) {
  TangentWrench spring(K_hand, 0);
  ToolWrench wrench = sample_wrench();
  wrench.tip = {0.1, 0, 0};
  wrench.p_WT = {0.5, 0, 0};  // where the hand is does not matter for moments
  wrench.set_point = {0, 0, 0};
  wrench.moment = array(Vec3(wrench.tip[0], 0, 0).cross(Vec3(0, 0, 0.4)) + Vec3(0, 0.02, 0));
  spring.take(wrench, 0.01);
  const ContactResult felt = rest(spring, hand_at({0.5, 0, 0}), 200);
  EXPECT_LT((felt.torque - Vec3(0, 0.02, 0)).norm(), 1e-9);
}

TEST(TangentWrench, PushesAndNeverPulls) {
  TangentWrench spring(K_hand, 0);
  spring.take(sample_wrench(), 0.01);
  rest(spring, hand_at(Vec3::Zero()), 200);
  double last = 0.4;
  for (int i = 1; i <= 100; ++i) {
    const ContactResult felt = spring.tick(hand_at({0, 0, 1e-4 * i}), dt);
    EXPECT_GE(felt.force.z(), 0);
    EXPECT_LE(felt.force.z(), last + 1e-12);
    last = felt.force.z();
  }
  EXPECT_EQ(rest(spring, hand_at({0, 0, 0.01}), 50).force, Vec3(Vec3::Zero()));
}

TEST(TangentWrench, IsNoStifferThanTheHandMayFeel) {
  TangentWrench spring(K_hand, 0);
  ToolWrench wrench = sample_wrench();
  wrench.stiffness[14] = 1e5;
  wrench.stiffness[28] = 0;
  wrench.moment = {};
  spring.take(wrench, 0.01);
  EXPECT_NEAR(rest(spring, hand_at(Vec3::Zero()), 300).force.z(), 0.4, 1e-9) << "the force itself stays";
  EXPECT_NEAR(spring.tick(hand_at({0, 0, -1e-4}), dt).force.z(), 0.4 + K_hand * 1e-4, 1e-9);
}

TEST(TangentWrench, ChangesNoFasterThanAnswersMay) {
  TangentWrench spring(K_hand, 0);
  ToolWrench wrench = sample_wrench();
  spring.take(wrench, dt);
  rest(spring, hand_at(Vec3::Zero()), 200);
  const double before = spring.work();
  wrench.force = {0, 0, 40};
  spring.take(wrench, dt);
  double last = 0.4, longest = 0;
  for (int i = 0; i < 100; ++i) {
    const double now = spring.tick(hand_at(Vec3::Zero()), dt).force.z();
    longest = std::max(longest, now - last);
    last = now;
  }
  EXPECT_LE(longest, 0.08 + 1e-9);
  EXPECT_LE(spring.work() - before, WorkTank::capacity + 0.1 * WorkTank::trickle + 1e-12);
  EXPECT_GT(last, 0.45);
}

/// Energy made of nothing on a closed way of the hand, 2 mm and 0.02 rad about where it rests [J].
/// @param felt  at rest
double made_by_a_loop(TangentWrench& spring, ContactResult felt, std::mt19937_64& random,
                      std::normal_distribution<double>& g) {
  const double before_loop = spring.work() - felt.stored;
  const Vec3 a = 0.002 * Vec3(g(random), g(random), g(random)),
             b = 0.002 * Vec3(g(random), g(random), g(random));
  const Vec3 axis = Vec3(g(random), g(random), g(random)).normalized();
  double given = 0;
  HandMotion last = hand_at(Vec3::Zero());
  constexpr int n = 12000;
  for (int i = 1; i <= n; ++i) {
    const double s = 2 * M_PI * i / n;
    HandMotion hand;
    hand.x = std::sin(s) * a + (1 - std::cos(s)) * b;
    hand.q = Eigen::AngleAxisd(0.02 * std::sin(2 * s), axis);
    const ContactResult before = felt;
    felt = spring.tick(hand, dt);
    const Vec6 motion = motion_between(last.x, last.q, hand.x, hand.q);
    given += 0.5 * (before.force + felt.force).dot(motion.head<3>()) +
             0.5 * (before.torque + felt.torque).dot(motion.tail<3>());
    last = hand;
  }
  return given - (spring.work() - felt.stored - before_loop);
}

/// One answer is one spring: what a hand gets on any way round it has put in before, and the tank at the most.
TEST(TangentWrench, GivesNoEnergyOnAClosedWay) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> g;
    // Two contacts: a wrench and a stiffness that belong together.
    ToolWrench wrench;
    wrench.tick = 1;
    Vec6 W = Vec6::Zero();
    Mat6 K = Mat6::Zero();
    for (int i = 0; i < 2; ++i) {
      const Vec3 n = Vec3(0.4 * g(random), 0.4 * g(random), 1).normalized();
      const Vec3 arm = 0.03 * Vec3(g(random), g(random), g(random));
      Vec6 contact;
      contact << n, arm.cross(n);
      W += 0.3 * contact;
      K += 150 * contact * contact.transpose();
    }
    wrench.force = array(Vec3(W.head<3>()));
    wrench.moment = array(Vec3(W.tail<3>()));
    Eigen::Map<Mat6>(wrench.stiffness.data()) = K;
    TangentWrench spring(1e6, 0);
    spring.take(wrench, 0.01);
    const ContactResult felt = rest(spring, hand_at(Vec3::Zero()), 300);
    // The trapezoid rule over a force with corners makes 1e-6.
    EXPECT_LE(made_by_a_loop(spring, felt, random, g), 4e-6) << "seed " << seed;
  }
}

/// A blade goes on through tissue at 0.2 m/s: what it takes stays the same, though its spring would be pressed by 160 N/s. Then it is out.
TEST(TangentWrench, FeelsWhatYieldsAndWhatHasBeenLeftHoweverFastTheHandGoes) {
  TangentWrench spring(K_hand, 0);
  const double speed = 0.2, bears = 2;
  const auto at = [&](int tick) { return Vec3(-speed * dt * tick, 0, 0); };
  ToolWrench wrench;
  wrench.stiffness[0] = wrench.stiffness[7] = 800;
  double most = 0, felt = 0, most_after = 0;
  for (int tick = 2; tick < 300; ++tick) {
    wrench.tick = static_cast<std::uint64_t>(tick);
    wrench.p_WT = array(at(tick - 2));
    wrench.force = {bears, 0, 0};
    spring.take(wrench, dt);
    most = std::max(most, felt = spring.tick(hand_at(at(tick)), dt).force.norm());
  }
  EXPECT_GT(felt, bears);
  EXPECT_LT(most, bears + 800 * speed * 3 * dt) << "what the hand's way since the answer makes";
  wrench.force = {0, 0, 0};
  wrench.stiffness = {};
  for (int tick = 300; tick < 400; ++tick) {
    wrench.p_WT = array(at(tick - 2));
    spring.take(wrench, dt);
    felt = spring.tick(hand_at(at(tick)), dt).force.norm();
    if (tick > 350) most_after = std::max(most_after, felt);
  }
  EXPECT_LT(most_after, 0.01);
}

/// What forceps carry along swings at their spring: bears(t) changes its sign while the hand goes on at 0.3 m/s,
/// where its spring alone would grow by 240 N/s.
double most_felt_beside_a_swing(double grip, double amplitude, double last = 0.3) {
  TangentWrench spring(K_hand, 0, 20, 0, grip);
  const double speed = 0.3;
  const auto at = [&](int tick) { return Vec3(-speed * dt * tick, 0, 0); };
  ToolWrench wrench;
  wrench.stiffness[0] = wrench.stiffness[7] = wrench.stiffness[14] = K_hand;
  double most = 0;
  for (int tick = 2; tick < last / dt; ++tick) {
    wrench.tick = static_cast<std::uint64_t>(tick);
    wrench.p_WT = array(at(tick - 2));
    wrench.force = {0.6 + amplitude * std::sin(40 * dt * tick), 0, 0};
    spring.take(wrench, dt);
    most = std::max(most, spring.tick(hand_at(at(tick)), dt).force.norm());
  }
  return most;
}

TEST(TangentWrench, DoesNotRunAwayFromWhatIsCarriedAlong) {
  const double since_the_answer = K_hand * 0.3 * 3 * dt;
  for (const double grip : {0.0, 5.0})
    for (const double amplitude : {0.0, 0.5, 1.5})
      EXPECT_LT(most_felt_beside_a_swing(grip, amplitude), 0.6 + amplitude + since_the_answer)
          << grip << " " << amplitude;
}

/// What yields under the hand takes what the hand gives, and not what a spring would hold whose force grew on the way.
TEST(TangentWrench, LosesNoMoreThanTheHandGives) {
  TangentWrench spring(K_hand, 0, 20, 0, 5);
  const double way = 0.3 * dt;
  ToolWrench wrench;
  wrench.stiffness[0] = wrench.stiffness[7] = wrench.stiffness[14] = K_hand;
  wrench.force = {0.6, 0, 0};
  double given = 0, felt = 0, lost_before = 0;
  for (int tick = 2; tick < 300; ++tick) {
    if (tick == 100) given = 0, lost_before = spring.work();
    given += felt * way;
    wrench.p_WT = array(Vec3(-way * (tick - 2), 0, 0));
    spring.take(wrench, dt);
    felt = spring.tick(hand_at(Vec3(-way * tick, 0, 0)), dt).force.x();
  }
  EXPECT_GT(given, 0.03);
  EXPECT_NEAR(lost_before - spring.work(), given, 0.02 * given);
}

TEST(TangentWrench, ThatHoldsGivesNoMoreThanItsGrip) {
  EXPECT_LE(most_felt_beside_a_swing(1, 1.5), 1 + 1e-12);
  EXPECT_GT(most_felt_beside_a_swing(1, 1.5), 0.99);
}

/// Forceps that hold pull as well as they push.
TEST(TangentWrench, ThatHoldsPullsToo) {
  TangentWrench spring(K_hand, 0, 20, 0, 5);
  ToolWrench wrench;
  wrench.stiffness[0] = wrench.stiffness[7] = wrench.stiffness[14] = K_hand;
  wrench.force = {0.2, 0, 0};
  spring.take(wrench, dt);
  rest(spring, hand_at(Vec3::Zero()), 300);
  const ContactResult pulled = spring.tick(hand_at(Vec3(1e-3, 0, 0)), dt);
  EXPECT_NEAR(pulled.force.x(), 0.2 - K_hand * 1e-3, 0.1) << "an answer may undo 80 N/s of it";
}

TEST(TangentWrench, ForgetsThePlaceWhereNothingHolds) {
  TangentWrench spring(K_hand, 0);
  ToolWrench wrench = sample_wrench();
  spring.take(wrench, dt);
  rest(spring, hand_at(Vec3::Zero()), 300);
  // A long way along the surface, with answers that follow.
  for (int i = 1; i <= 200; ++i) {
    const Vec3 x(2e-4 * i, 0, 0);
    wrench.p_WT = array(x);
    wrench.tip = array(x);
    wrench.set_point = array(x);
    wrench.tick += 1;
    spring.take(wrench, dt);
    EXPECT_NEAR(spring.tick(hand_at(x), dt).force.z(), 0.4, 1e-6);
  }
  // The surface turns under the tool: what was slid before does not come back as a stretch.
  const double before = spring.work();
  wrench.stiffness[0] = 200;
  wrench.force = {0.1, 0, 0.4};
  spring.take(wrench, dt);
  const ContactResult felt = rest(spring, hand_at({0.04, 0, 0}), 300);
  EXPECT_NEAR(felt.force.x(), 0.1, 1e-6);
  EXPECT_LT(spring.work() - before, 2 * (0.1 * 0.1 / 200));
}

/// A surface of 200 N/m that presses `arm` beside the tip and is spread there by 10 mm; the hand is at the origin.
ToolWrench sample_surface(double stretch, double arm = 0.02) {
  ToolWrench wrench;
  wrench.tick = 1;
  wrench.normal = {0, 0, 1};
  wrench.stretch = stretch;
  const Vec6 g(Vec6(0, 0, 1, 0, -arm, 0)), h(Vec6(0, 0, 0, 0, -0.01, 0));
  Eigen::Map<Mat6>(wrench.stiffness.data()) = 200 * (g * g.transpose() + h * h.transpose());
  return wrench;
}

TEST(TangentWrench, StandsReadyBeforeItIsTouched) {
  TangentWrench spring(K_hand, 0);
  spring.take(sample_surface(-0.001), 0.05);
  EXPECT_FALSE(spring.penetrated());
  for (int i = 0; i <= 10; ++i) {
    const ContactResult felt = spring.tick(hand_at({0.0002 * i, 0, -1e-4 * i}), dt);
    EXPECT_EQ(felt.n_planes, 0U) << i;
    EXPECT_EQ(felt.force, Vec3(Vec3::Zero())) << i;
  }
  for (int i = 1; i <= 20; ++i) {
    const ContactResult felt = spring.tick(hand_at({0.002, 0, -0.001 - 1e-4 * i}), dt);
    EXPECT_LT((felt.force - Vec3(0, 0, 200 * 1e-4 * i)).norm(), 1e-9) << i;
    EXPECT_NEAR(felt.torque.y(), -0.02 * felt.force.z(), 1e-9) << i;
  }
  EXPECT_NEAR(spring.work(), 0, 1e-12) << "the hand compressed it, nobody else";
  EXPECT_EQ(spring.tick(hand_at({0.002, 0, 0}), dt).n_planes, 0U);
}

/// Answers that tell the same surface from ever new poses change nothing, in light contact neither.
TEST(TangentWrench, KnowsASurfaceFromEveryPose) {
  TangentWrench spring(K_hand, 0);
  for (int i = 0; i < 400; ++i) {
    const double z = 0.0005 * std::cos(0.05 * i), told = 0.0005 * std::cos(0.05 * (i - 7));
    if (i % 10 == 0) {
      ToolWrench wrench = sample_surface(-told);
      wrench.p_WT = wrench.tip = wrench.set_point = {0, 0, told};
      spring.take(wrench, 0.01);
    }
    EXPECT_NEAR(spring.tick(hand_at({0, 0, z}), dt).force.z(), 200 * std::max(0.0, -z), 1e-9) << i;
  }
  EXPECT_NEAR(spring.work(), 0, 1e-12);
}

TEST(TangentWrench, BeginsAtTheHandThatIsInsideTheSurface) {
  TangentWrench spring(K_hand, 0);
  spring.take(sample_surface(0.005), dt);
  EXPECT_TRUE(spring.penetrated());
  double last = 0;
  for (int i = 0; i < 100; ++i) {
    const double now = spring.tick(hand_at(Vec3::Zero()), dt).force.z();
    EXPECT_LE(now - last, 0.08 + 1e-9);
    last = now;
  }
  EXPECT_LE(spring.work(), WorkTank::capacity + 0.1 * WorkTank::trickle + 1e-12);
  EXPECT_GT(last, 0.1) << "the tank pays for some";
}

TEST(TangentWrench, KeepsTheForceWhereTheTorqueEnds) {
  constexpr double torque_limit = 0.004;
  TangentWrench spring(K_hand, 0, 3, torque_limit);
  ContactResult felt;
  // Answers follow a hand that presses slowly.
  for (int i = 0; i <= 300; ++i) {
    const Vec3 x(0, 0, -1e-5 * i);
    ToolWrench wrench = sample_surface(1e-5 * i);
    wrench.p_WT = wrench.tip = wrench.set_point = array(x);
    spring.take(wrench, dt);
    felt = spring.tick(hand_at(x), dt);
    EXPECT_LE(felt.torque.norm(), torque_limit + 1e-12);
    EXPECT_NEAR(felt.force.z(), 200 * 1e-5 * i, 0.001) << i;
  }
  EXPECT_NEAR(felt.torque.y(), -torque_limit, 1e-6);
}

/// 200 N/m at 0.2 m turn as 3400 N/m at 5 cm would.
TEST(TangentWrench, IsSofterAtALongArmButNotWeaker) {
  TangentWrench spring(K_hand, 0);
  spring.take(sample_surface(0.003, 0.2), dt);
  const double force = rest(spring, hand_at(Vec3::Zero()), 2000).force.z();
  EXPECT_NEAR(force, 0.6, 1e-6);
  const double k = (spring.tick(hand_at({0, 0, -1e-4}), dt).force.z() - force) / 1e-4;
  EXPECT_LT(k * (1 + 16), K_hand * 1.01);
  EXPECT_GT(k * (1 + 16), K_hand * 0.9);
  TangentWrench above(K_hand, 0);
  above.take(sample_surface(-0.003, 0.2), dt);
  EXPECT_EQ(above.tick(hand_at({0, 0, 0}), dt).n_planes, 0U);
  EXPECT_EQ(above.tick(hand_at({0, 0, -0.00299}), dt).n_planes, 0U);
  EXPECT_EQ(above.tick(hand_at({0, 0, -0.00301}), dt).n_planes, 1U) << "it is touched where it is";
}

TEST(TangentWrench, KnowsNothingFarFromTheAnswer) {
  TangentWrench spring(K_hand, 0);
  spring.take(sample_surface(-0.001), dt);
  spring.tick(hand_at(Vec3::Zero()), dt);
  for (int i = 1; i <= 50; ++i)
    EXPECT_EQ(spring.tick(hand_at({0.06, 0, -1e-4 * i}), dt).n_planes, 0U) << "no surface is known there";
}

TEST(TangentWrench, GivesNoEnergyOnAClosedWayThroughASurface) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> g;
    TangentWrench spring(K_hand, 0);
    spring.take(sample_surface(0.001 * g(random), 0.03 * g(random)), 0.01);
    const ContactResult felt = rest(spring, hand_at(Vec3::Zero()), 1000);
    EXPECT_LE(made_by_a_loop(spring, felt, random, g), 4e-6) << "seed " << seed;
  }
}

}  // namespace
}  // namespace palpate::haptic
