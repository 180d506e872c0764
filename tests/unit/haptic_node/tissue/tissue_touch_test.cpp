#include "haptic_node/tissue/tissue_touch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/unit/haptic_node/tissue/some_tissues.h"

namespace palpate::haptic {
namespace {

using std::numbers::pi;

constexpr double h = 1e-3;

/// Above the tissue at first, then 2 mm deep with 0.5 mm of swing.
double depth(int n) {
  const double t = std::max(0.0, n * h - 0.3);
  return -2e-3 + 4e-3 * std::min(1.0, t / 0.1) + 0.5e-3 * std::sin(2 * pi * 5 * t);
}

/// The tissue itself, pressed by the hand's samples, with all that it was at each.
class TrueTissue {
 public:
  explicit TrueTissue(const TissueModel& model) : step_(model, {500, 1}, h) { states_.emplace_back(); }
  void press(const TipSample& hand) {
    states_.push_back(states_.back());
    step_.advance(states_.back(), hand);
  }
  TissueAnswer answer(std::uint64_t stamp) const {
    TissueAnswer answer;
    answer.stamp = stamp;
    answer.model = step_.model();
    answer.state = states_[stamp];
    return answer;
  }
  const Vec3& force(std::uint64_t stamp) const { return states_[stamp].force; }

 private:
  TissueStep step_;
  std::vector<TissueState> states_;
};

TissueTouch touch_of_a_hand() { return TissueTouch({{500, 1}, h, 3, 0}); }

/// A model that is right is felt as it bears, whatever the age of its answers; nothing is paid and nothing held back.
TEST(TissueTouch, FeelsWhatIsBorneWhereTheModelIsRight) {
  for (const TissueModel& model : some_tissues())
    for (const int age : {1, 20, 100, 250}) {
      TrueTissue tissue(model);
      TissueTouch touch = touch_of_a_hand();
      double least = 1;
      for (int n = 1; n <= 1500; ++n) {
        touch.tick(down(depth(n)), 1.0);
        tissue.press(touch.history().at(touch.history().newest()));
        const auto now = static_cast<std::uint64_t>(n);
        if (n % 7 == 0 && n > age) {
          EXPECT_TRUE(touch.take(tissue.answer(now - static_cast<std::uint64_t>(age))));
        }
        ASSERT_NEAR((touch.felt_copy().state.force - tissue.force(now)).norm(), 0, 1e-11) << n;
        least = std::min(least, touch.share());
      }
      EXPECT_EQ(least, 1) << model.n_modes << age;
      EXPECT_NEAR(touch.correction_work(), 0, 1e-12);
    }
}

/// The same for a tip that slides to and fro over a slope, sticks at its turns, and is answered late.
TEST(TissueTouch, FeelsWhatIsBorneOfWhatItSlidesOn) {
  for (const double friction : {0.0, 0.3})
    for (const int age : {1, 20, 100}) {
      TrueTissue tissue(leaning(friction));
      TissueTouch touch = touch_of_a_hand();
      double across = 0;
      for (int n = 1; n <= 1500; ++n) {
        const double t = std::max(0.0, n * h - 0.5);
        touch.tick(down(depth(n)) + 6e-3 * std::sin(2 * pi * 1.5 * t) * Vec3(0.6, 0.8, 0), 1.0);
        tissue.press(touch.history().at(touch.history().newest()));
        const auto now = static_cast<std::uint64_t>(n);
        if (n % 7 == 0 && n > age) {
          EXPECT_TRUE(touch.take(tissue.answer(now - static_cast<std::uint64_t>(age))));
        }
        ASSERT_NEAR((touch.felt_copy().state.force - tissue.force(now)).norm(), 0, 1e-11) << n;
        across = std::max(across, std::abs(tissue.force(now).y()));
      }
      EXPECT_EQ(across > 0.05, friction > 0) << "it rubs";
      EXPECT_NEAR(touch.correction_work(), 0, 1e-12);
    }
}

/// A tool that is pressed at the end of an arm and turned about its tip: the copy feels what the tissue bears there, whatever the age of
/// answers, and the arm that they tell is the handle's as it lay at their sample.
TEST(TissueTouch, FeelsWhatATurningToolPresses) {
  const Vec3 arm(0.05, 0, 0);
  for (const int age : {1, 20, 100}) {
    TissueTouch touch = touch_of_a_hand();
    TissueStep step(leaning(0.3), {500, 1}, h);
    std::vector<TissueState> states(1);
    std::vector<Vec3> arms(1, arm);
    for (int n = 1; n <= 1500; ++n) {
      const double t = std::max(0.0, n * h - 0.15);
      const double angle = 0.04 * std::min(1.0, t / 0.3) + 0.01 * std::sin(2 * pi * 2 * t);
      const Eigen::Quaterniond q(Eigen::AngleAxisd(angle, Vec3::UnitY()));  // +x goes down
      touch.tick(Vec3(0, 0, -0.0142), q, 1.0);
      states.push_back(states.back());
      step.advance(states.back(), touch.history().at(touch.history().newest()).point(arm));
      arms.emplace_back(q * arm);
      if (n % 7 == 0 && n > age) {
        const auto then = static_cast<std::size_t>(n - age);
        TissueAnswer answer;
        answer.stamp = then;
        answer.arm = arms[then];
        answer.model = step.model();
        answer.state = states[then];
        EXPECT_TRUE(touch.take(answer));
      }
      if (n > 150) {
        ASSERT_NEAR((touch.felt_copy().state.force - states.back().force).norm(), 0, 1e-9) << n << " " << age;
        ASSERT_NEAR((touch.arm() - q * arm).norm(), 0, 1e-12);
      }
    }
    EXPECT_GT(touch.felt().norm(), 0.1);
  }
}

/// Forces that come in over half a second after arming, and go: tissue that is pressed by the spring as it then is bears what is felt.
TEST(TissueTouch, FeelsWhatIsBorneWhileItsSpringComesAndGoes) {
  const TissueModel model = some_tissues()[3];
  TissueTouch touch = touch_of_a_hand();
  std::vector<TissueState> states(1);
  double most = 0, off = 0;
  for (int n = 1; n <= 1200; ++n) {
    const double gain = std::clamp(std::min((n - 300) / 500.0, (1100 - n) / 200.0), 0.0, 1.0);
    touch.tick(down(depth(n)), gain);
    states.push_back(states.back());
    if (gain > 0)
      TissueStep(model, {gain * 500, gain * 1}, h)
          .advance(states.back(), touch.history().at(touch.history().newest()));
    if (n > 10) {
      TissueAnswer answer;
      answer.stamp = static_cast<std::uint64_t>(n - 10);
      answer.model = model;
      answer.state = states[answer.stamp];
      touch.take(answer);
    }
    most = std::max(most, states.back().force.norm());
    off = std::max(off, (touch.felt() + states.back().force).norm());
  }
  EXPECT_GT(most, 0.3);
  EXPECT_LT(off, 0.1 * most) << "an answer of 10 ms ago is replayed with the spring of now: 5 % of it";
}

/// Another point of the tool bears: what is felt goes on without a jump.
TEST(TissueTouch, KeepsItsForceWhereTheArmChanges) {
  TissueTouch touch = touch_of_a_hand();
  TissueAnswer wall;
  wall.model.friction = 0.5;
  const auto answer = [&](std::uint64_t stamp, const Vec3& arm) {
    wall.stamp = stamp;
    wall.arm = arm;
    wall.state.rest = Vec3(arm.x(), arm.y(), 0);
    wall.state.force = Vec3(0, 0, -0.5);
    touch.take(wall);
  };
  for (int n = 1; n <= 300; ++n) {
    touch.tick(Vec3(0, 0, std::max(-1e-3, 1e-3 - 2e-5 * n)), 1.0);
    if (n > 1) answer(static_cast<std::uint64_t>(n), Vec3::Zero());
  }
  const Vec3 before = touch.felt();
  EXPECT_NEAR(before.z(), 0.5, 0.01);
  answer(300, Vec3(0.03, 0.01, 0));
  touch.tick(Vec3(0, 0, -1e-3), 1.0);
  EXPECT_NEAR((touch.felt() - before).norm(), 0, 1e-3);
  EXPECT_NEAR((touch.arm() - Vec3(0.03, 0.01, 0)).norm(), 0, 1e-12);
}

/// To replay is to have been there.
TEST(TissueTouch, ReplaysToTheSameState) {
  for (const TissueModel& model : some_tissues()) {
    TrueTissue tissue(model);
    TissueTouch touch = touch_of_a_hand();
    for (int n = 1; n <= 500; ++n) {
      touch.tick(down(depth(n)), 1.0);
      tissue.press(touch.history().at(touch.history().newest()));
    }
    ASSERT_TRUE(touch.take(tissue.answer(300)));
    const TissueAnswer now = tissue.answer(500);
    EXPECT_EQ(touch.shadow_copy().state.q, now.state.q);
    EXPECT_EQ(touch.shadow_copy().state.w, now.state.w);
    EXPECT_EQ(touch.shadow_copy().state.p, now.state.p);
    EXPECT_EQ(touch.shadow_copy().state.force, now.state.force);
  }
}

/// The shadow goes on by itself: with a right model further answers change nothing.
TEST(TissueTouch, NeedsNoMoreAnswersWhereTheModelIsRight) {
  TrueTissue tissue(some_tissues()[3]);
  TissueTouch touch = touch_of_a_hand(), alone = touch_of_a_hand();
  for (int n = 1; n <= 800; ++n) {
    EXPECT_NEAR((touch.tick(down(depth(n)), 1.0) - alone.tick(down(depth(n)), 1.0)).norm(), 0, 1e-12);
    tissue.press(touch.history().at(touch.history().newest()));
    const TissueAnswer answer = tissue.answer(static_cast<std::uint64_t>(n));
    if (n <= 10) {
      EXPECT_TRUE(alone.take(answer));
    }
    EXPECT_TRUE(touch.take(answer));
  }
  EXPECT_GT(touch.felt().z(), 0.1);
}

TEST(TissueTouch, TakesNoAnswerOfAForgottenSample) {
  TrueTissue tissue(some_tissues()[0]);
  TissueTouch touch = touch_of_a_hand();
  EXPECT_FALSE(touch.take(tissue.answer(0)));
  for (int n = 1; n <= 400; ++n) {
    touch.tick(down(depth(n)), 1.0);
    tissue.press(touch.history().at(touch.history().newest()));
  }
  EXPECT_FALSE(touch.take(tissue.answer(400 - TipHistory::kept)));
  EXPECT_TRUE(touch.take(tissue.answer(401 - TipHistory::kept)));
  TissueAnswer to_come = tissue.answer(400);
  to_come.stamp = 401;
  EXPECT_FALSE(touch.take(to_come));
}

/// A hand that is deep in tissue when it first hears of it feels nothing at once, and no more than the tank has paid.
TEST(TissueTouch, BeginsAtTheHand) {
  TissueTouch touch = touch_of_a_hand();
  for (int n = 0; n < 200; ++n) EXPECT_TRUE(touch.tick(down(20e-3), 1.0).isZero());
  TissueAnswer answer;
  answer.model = lump(0.1, 2, 200);
  answer.stamp = 200;
  ASSERT_TRUE(touch.take(answer));
  EXPECT_TRUE(touch.tick(down(20e-3), 1.0).isZero());
  double sent = 0;
  for (int n = 1; n <= 500; ++n) {
    const double command = touch.tick(down(20e-3), 1.0).z();
    EXPECT_LE(command - sent, ForceGuard::kick + 1e-9);
    sent = command;
    EXPECT_LE(touch.correction_work(), WorkTank::capacity + WorkTank::trickle * h * n);
  }
  EXPECT_GT(touch.felt().z(), 0.2);  // it does come
}

/// A model that turns out wrong is corrected, and what its correction puts in is paid.
TEST(TissueTouch, PaysForWhatItDidNotKnow) {
  for (const double stiffness : {50.0, 100.0, 400.0, 1000.0}) {
    TrueTissue tissue(lump(0.1, 2, 200));
    TissueTouch touch = touch_of_a_hand();
    double paid = 0, least = 0;
    for (int n = 1; n <= 3000; ++n) {
      touch.tick(down(depth(std::min(n, 1000))), 1.0);
      tissue.press(touch.history().at(touch.history().newest()));
      TissueAnswer answer = tissue.answer(static_cast<std::uint64_t>(n));
      if (n < 450) answer.model = lump(0.1, 2, stiffness);
      touch.take(answer);
      paid = touch.correction_work() - WorkTank::trickle * h * n;
      least = std::min(least, paid);
      EXPECT_LE(paid, least + WorkTank::capacity + 1e-15);
    }
    EXPECT_NEAR((touch.felt() + tissue.force(3000)).norm(), 0, 2e-3);
  }
}

/// A fade that is turned round in contact goes on where it is; what has gone is forgotten.
TEST(TissueTouch, ComesBackFromSilenceWithoutAJump) {
  TrueTissue tissue(lump(0.1, 2, 200));
  TissueTouch touch = touch_of_a_hand();
  double before = 0, most = 0;
  for (int n = 1; n <= 2000; ++n) {
    const double gain = n < 600 ? 1.0 : n < 700 ? 1 - 0.005 * (n - 600) : 1.0;
    const double force = touch.tick(down(-2e-3 + 4e-3 * std::min(1.0, n * h / 0.1)), gain).z();
    tissue.press(touch.history().at(touch.history().newest()));
    touch.take(tissue.answer(static_cast<std::uint64_t>(n)));
    if (n > 500) most = std::max(most, force - before);
    before = force;
  }
  EXPECT_LE(most, TissueTouch::slew * h + 1e-9);
  EXPECT_NEAR(before, -tissue.force(2000).z(), 1e-3);
  EXPECT_TRUE(touch.tick(down(2e-3), 0.0).isZero());
  EXPECT_TRUE(touch.tick(down(2e-3), 1.0).isZero());  // nothing is known of tissue now
}

/// Counts of modes may change out of contact only.
TEST(TissueTouch, KeepsItsKindOfModelWhileItTouches) {
  TissueTouch touch = touch_of_a_hand();
  TissueAnswer answer;
  answer.model = lump(0.1, 2, 200);
  touch.tick(down(-1e-3), 1.0);
  answer.stamp = 1;
  ASSERT_TRUE(touch.take(answer));
  for (int n = 2; n <= 200; ++n) touch.tick(down(std::min(2e-3, -1e-3 + 2e-5 * n)), 1.0);
  ASSERT_TRUE(touch.touching());
  TissueAnswer other = answer;
  other.model = some_tissues()[3];
  other.stamp = 200;
  EXPECT_FALSE(touch.take(other));
  for (int n = 201; n <= 400; ++n) touch.tick(down(-1e-3), 1.0);
  other.stamp = 400;
  EXPECT_TRUE(touch.take(other));
}

/// Force of a hand that moves in leads it by what a hold of 1.5 ticks costs, never by more than half.
TEST(TissueTouch, PaysTheHoldInAdvance) {
  TissueTouch touch = touch_of_a_hand();
  TissueAnswer wall;
  touch.tick(down(-1e-3), 1.0);
  wall.stamp = 1;
  ASSERT_TRUE(touch.take(wall));
  constexpr double speed = 0.1;
  for (int n = 2; n <= 100; ++n) {
    const double sent = touch.tick(down(-1e-3 + speed * h * (n - 1)), 1.0).z();
    const double paid = 500 * TissueTouch::hold * h * speed;
    if (n > 60) {
      EXPECT_NEAR(sent, touch.felt().z() + paid, 1e-9);
    }
    EXPECT_LE(sent, 1.5 * touch.felt().z() + 1e-12);
    if (sent > 2.5) break;
  }
}

}  // namespace
}  // namespace palpate::haptic
