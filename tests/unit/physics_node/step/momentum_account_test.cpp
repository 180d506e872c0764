// The books of momentum against particles that are stepped one by one.

#include "physics_node/step/momentum_account.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

struct Particle {
  double mass;
  Vec3 x, v;
};

Momenta momenta_of(const std::vector<Particle>& particles) {
  Momenta sum;
  for (const Particle& p : particles) {
    sum.linear += p.mass * p.v;
    sum.angular += p.x.cross(p.mass * p.v);
  }
  return sum;
}

MomentumAccount::Start start_of(const std::vector<Particle>& particles) {
  MomentumAccount::Start start;
  start.momenta = momenta_of(particles);
  for (const Particle& p : particles) {
    start.mass_moment += p.mass * p.x;
    start.mass += p.mass;
    start.linear += p.mass * p.v.norm();
    start.angular += p.x.cross(p.mass * p.v).norm();
  }
  return start;
}

std::vector<Particle> some_particles() {
  test::Dice dice(5);
  std::vector<Particle> particles;
  for (int n = 0; n < 7; ++n)
    particles.push_back({dice.between(0.001, 0.01), dice.within(0.1), dice.within(2)});
  return particles;
}

class MomentumBooks : public testing::Test {
 protected:
  MomentumBooks() { account_.restart(start_of(particles_)); }

  void fall(int steps) {
    for (int n = 0; n < steps; ++n) {
      for (Particle& p : particles_) {
        p.v += dt * gravity;
        p.x += dt * p.v;
      }
      account_.step(gravity, dt, dt);
    }
  }
  void expect_balanced() const {
    const MomentumBalance balance = account_.balance(momenta_of(particles_));
    EXPECT_LT(balance.missing.linear.norm(), 1e-13 * balance.linear);
    EXPECT_LT(balance.missing.angular.norm(), 1e-13 * balance.angular);
  }

  static constexpr double dt = 1e-3;
  const Vec3 gravity{0.5, -2, -9.81};
  std::vector<Particle> particles_ = some_particles();
  MomentumAccount account_;
};

/// Gravity gives M g t, and about the origin the moment of the centre that falls.
TEST_F(MomentumBooks, BalanceInFreeFall) {
  fall(500);
  expect_balanced();
}

/// What acts between masses is not booked, and changes nothing in the books.
TEST_F(MomentumBooks, MissNothingThatMassesGiveEachOther) {
  const Vec3 along = particles_[1].x - particles_[0].x;
  const Vec3 J = 0.02 * along;
  particles_[0].v += J / particles_[0].mass;
  particles_[1].v -= J / particles_[1].mass;
  fall(3);
  expect_balanced();
}

TEST_F(MomentumBooks, BookImpulsesWhereTheyAct) {
  const Vec3 J{0.001, 0.002, -0.003};
  particles_[2].v += J / particles_[2].mass;
  account_.hit(J, particles_[2].x);
  fall(10);
  expect_balanced();
  // An impulse at the beginning of the step just made: the mass has moved on with it.
  const Vec3 from = particles_[3].x, dv = J / particles_[3].mass;
  fall(1);
  particles_[3].v += dv;
  particles_[3].x += dt * dv;
  account_.push(J, from, dt);
  fall(10);
  expect_balanced();
  EXPECT_EQ(account_.hits(), 2);
}

/// A push that nobody books is seen, with its size and its moment.
TEST_F(MomentumBooks, ShowWhatIsNotBooked) {
  const Vec3 J{0, 0, 1e-5};
  particles_[4].v += J / particles_[4].mass;
  const MomentumBalance balance = account_.balance(momenta_of(particles_));
  EXPECT_LT((balance.missing.linear - J).norm(), 1e-12);
  EXPECT_LT((balance.missing.angular - particles_[4].x.cross(J)).norm(), 1e-13);
}

}  // namespace
}  // namespace palpate::physics
