// Bodies of finite elements that yield: what is lost is booked, what must stay stays, and a dent is one for good. The law of one cell:
// tests/unit/physics_node/step/fem/hex_plastic_test.cpp.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>

#include "physics_node/step/lattice/hex_marks.h"
#include "physics_node/step/lattice/hex_meter.h"
#include "physics_node/step/lattice/hexahedra.h"
#include "physics_node/step/lattice/measure.h"
#include "physics_node/world.h"
#include "tests/support/physics/small_worlds.h"
#include "tests/support/physics/solid_box.h"

namespace palpate::physics::test {
namespace {

Recipe clay_bar(double edge_mm, const std::string& law) {
  Recipe recipe = solid_box(40, 10, 10, edge_mm);
  recipe.material += "\n" + law;
  return recipe;
}

/// A bar whose left end is held and whose right end is led along it, with sides that are free; and what that takes.
class LedBar {
 public:
  explicit LedBar(const Recipe& recipe) : body_(ends_held(recipe)), state_(body_), elements_(body_, state_) {}

  /// Work is that of the trapezoid, as the leapfrog keeps its energy by, with the forces after cells have flowed.
  std::int64_t step(double speed, double dt, bool watch = true) {
    const std::vector<Vec3> before = displacements();
    for (const Index node : led_) state_.v[0][static_cast<std::size_t>(node)] = speed;
    const StepOutcome outcome = elements_.step(body_, state_, {.dt = dt, .watch = watch});
    const std::vector<Vec3> after = displacements();
    displace(before);
    settled_ += 0.5 * (last_ + dt * speed) * pull();
    displace(after);
    last_ = dt * speed;
    moved_ += last_;
    return outcome.broken;
  }
  /// Force that leads the end on [N].
  double pull() const {
    const HexGrid grid = make_hex_grid(body_);
    const MeasuredHexahedra now = measure_hexahedra(body_, grid, state_);
    double sum = 0;
    for (const Index node : led_) sum -= now.force[static_cast<std::size_t>(node)].x();
    return sum;
  }
  double energy() const {
    const Energies now = elements_.energies(body_, state_, Vec3::Zero());
    return now.between + now.elastic;
  }
  Losses losses() const { return measure_losses(state_); }
  double missing() const {
    const Losses lost = losses();
    return work() - energy() - lost.plastic - lost.numerical - lost.broken - lost.viscous;
  }
  double work() const { return settled_ + 0.5 * last_ * pull(); }
  double moved() const { return moved_; }
  const Body& body() const { return body_; }
  const LatticeState<double>& state() const { return state_; }
  BodyCounts counts() const { return elements_.counts(body_, state_); }

 private:
  Body ends_held(const Recipe& recipe) {
    Body body = body_of(recipe);
    for (const Index node : body.nodes()) {
      const double x = body.rest_position(node).x();
      if (std::abs(x) < 0.0199) continue;
      body.inverse_mass[static_cast<std::size_t>(node)] = 0;
      ++body.n_held;
      if (x > 0) led_.push_back(node);
    }
    return body;
  }

  std::vector<Vec3> displacements() const {
    std::vector<Vec3> u;
    for (const Index node : body_.nodes()) u.push_back(vector_of(state_.u, node));
    return u;
  }
  void displace(const std::vector<Vec3>& u) {
    for (std::size_t n = 0; n < u.size(); ++n) write(state_.u, body_.nodes()[n], u[n]);
  }

  std::vector<Index> led_;
  Body body_;
  LatticeState<double> state_;
  Hexahedra<double> elements_;
  double settled_ = 0, last_ = 0, moved_ = 0;
};

/// Led to and fro: all work is in the books, and what is lost to yielding grows and never comes back.
TEST(Yield, BooksCyclesToTheElementsOwnError) {
  for (const char* law : {"yield_ratio = 1.05\nk2_ratio = 0", "yield_ratio = 1.05\nk2_ratio = 0.3"}) {
    double missing[2];
    for (int n = 0; n < 2; ++n) {
      LedBar bar(clay_bar(5, law));
      const double dt = 0.1e-3 / (n + 1);
      double plastic = 0;
      for (int step = 0; step < 2000 * (n + 1); ++step) {
        const double turn = step * dt / 0.1;
        bar.step(turn - std::floor(turn) < 0.25 || turn - std::floor(turn) > 0.75 ? 0.3 : -0.3, dt,
                 step % 4 == 0);
        EXPECT_GE(bar.losses().plastic, plastic);
        plastic = bar.losses().plastic;
      }
      std::printf("%s: plastic %.4g of %.4g J, numerical %.2g, missing %.2g\n", law, plastic, bar.work(),
                  bar.losses().numerical, bar.missing());
      EXPECT_GT(plastic, 0.3 * bar.work());
      EXPECT_LT(std::abs(bar.losses().numerical), 0.02 * plastic);
      missing[n] = std::abs(bar.missing()) / plastic;
      EXPECT_LT(missing[n], 1e-3);
    }
    EXPECT_LT(missing[1], 0.5 * missing[0]);
  }
}

/// A bar that is pulled slowly: what its middle takes and, when nothing pulls any more, how long it is there.
TEST(Yield, LeavesTheSetOfTheClosedForm) {
  LedBar bar(clay_bar(2.5, "yield_ratio = 1.05\nk2_ratio = 0.1\nviscosity_Pa_s = 1"));
  const Body& body = bar.body();
  const auto node_at = [&](double x) {
    for (const Index node : body.nodes())
      if ((body.rest_position(node) - Vec3(x, 0, 0)).norm() < 1e-6) return node;
    return Index{-1};
  };
  const Index left = node_at(0), right = node_at(2.5e-3);
  ASSERT_TRUE(left >= 0 && right >= 0);
  const auto middle_stretch = [&] {
    return 1 + (vector_of(bar.state().u, right) - vector_of(bar.state().u, left)).x() / 2.5e-3;
  };
  while (bar.moved() < 0.010) bar.step(0.05, 0.1e-3, false), bar.step(0.05, 0.1e-3);
  const double l = middle_stretch();
  const Lame lame = lame_of(10e3, 0.45);
  const Yielding yielding{1.05, 0.1};
  const double l_e = elastic_stretch(l, yielding, lame.mu, lame.lambda);
  EXPECT_GT(l, 1.15);
  const double stress = 2 * lame.mu * tension_limit(l_e, lame.mu, lame.lambda).tension;  // Kirchhoff's
  EXPECT_NEAR(bar.pull(), stress / l * 1e-4, 0.03 * stress * 1e-4);
  while (bar.pull() > 0) bar.step(-0.05, 0.1e-3, false);
  EXPECT_NEAR(std::log(middle_stretch()), std::log(l / l_e), 0.02 * std::log(l / l_e));
}

/// A free bar that is let go stretched and turning yields, and keeps its momenta and its energy.
TEST(Yield, KeepsMomentaAndEnergy) {
  const Body body = body_of(clay_bar(2.5, "yield_ratio = 1.03\nk2_ratio = 0.1"));
  LatticeState<double> state(body);
  Hexahedra<double> elements(body, state);
  const Eigen::Matrix3d F = Vec3(1.25, 0.9, 0.9).asDiagonal();
  place_masses<double>(body, state, [&F](const Vec3& X) { return Vec3(F * X); });
  const Vec3 spin(3, 10, 5);
  for (const Index node : body.nodes())
    write(state.v, node, Vec3(spin.cross(F * body.rest_position(node)) + Vec3(0.1, 0.2, -0.3)));
  const auto energy = [&] {
    const Energies now = elements.energies(body, state, Vec3::Zero());
    return now.between + now.elastic + measure_losses(state).plastic + measure_losses(state).numerical;
  };
  const auto before = measure_momenta(body, state.u, state.v).momenta;
  const double elastic = elements.energies(body, state, Vec3::Zero()).elastic;
  elements.step(body, state, {.dt = 0.05e-3, .watch = true});
  const double start = energy();
  for (int n = 0; n < 4000; ++n) elements.step(body, state, {.dt = 0.05e-3, .watch = n % 8 == 0});
  const auto after = measure_momenta(body, state.u, state.v).momenta;
  EXPECT_LT((after.linear - before.linear).norm(), 1e-12 * before.linear.norm());
  EXPECT_LT((after.angular - before.angular).norm(), 1e-12 * before.angular.norm());
  EXPECT_LT(std::abs(energy() - start), 2e-3 * elastic);
  EXPECT_GT(measure_losses(state).plastic, 0.2 * elastic);
  EXPECT_EQ(elements.counts(body, state).yielded_masses, body.n_nodes());
}

/// What is watched and what is measured one by one, in double, is the same energy.
TEST(Yield, WatchesTheEnergyThatItHas) {
  LedBar bar(clay_bar(2.5, "yield_ratio = 1.03\nk2_ratio = 0.1"));
  for (int n = 0; n < 400; ++n) bar.step(0.2, 0.1e-3);
  const double before = measure_hexahedra(bar.body(), make_hex_grid(bar.body()), bar.state()).elastic;
  const double lost = bar.losses().plastic + bar.losses().numerical;
  bar.step(0, 1e-12);  // flows where it stands, and watches
  double watched = 0;
  for (const RowLedger& row : bar.state().ledger) watched += row.elastic;
  EXPECT_NEAR(watched + bar.losses().plastic + bar.losses().numerical - lost, before, 0.02 * before);
  const double after = measure_hexahedra(bar.body(), make_hex_grid(bar.body()), bar.state()).elastic;
  EXPECT_NEAR(watched, after, 1e-9 * after);
}

/// A cube that falls onto its face, of two materials of which one yields.
Recipe falling(const std::string& precision, int threads) {
  Recipe recipe = solid_box(30, 20, 20, 2.5);
  const std::string tissue = recipe.material + "\nviscosity_Pa_s = 2\n";
  recipe.material = tissue + "yield_ratio = 1.05\nk2_ratio = 0.05";
  recipe.body +=
      "\nat_mm = [0, 0, 10]\nvelocity_m_per_s = [0.2, 0, -0.8]\nregions = [{ material = \"rubber\", "
      "box_min_mm = [0, -99, "
      "-99], box_max_mm = [99, 99, 99] }]";
  recipe.world = "[material.rubber]\n" + tissue + floor_at(0);
  recipe.precision = precision;
  recipe.physics = fmt::format("threads = {}", threads);
  recipe.gravity = "[0, 0, -9.81]";
  return recipe;
}

TEST(Yield, IsTheSameOnAnyNumberOfThreads) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 3, 8}) {
    World world(scene_of(falling("single", threads)));
    run(world, 0.05);
    EXPECT_GT(world.body(0).losses().plastic, 0);
    hashes.push_back(world.state_hash());
  }
  for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes.front());
}

/// The half that cannot yield does not, the other one keeps a dent, and books hold, also in single precision.
TEST(Yield, LeavesADentWhereTheMaterialYields) {
  double plastic[2];
  for (int n = 0; n < 2; ++n) {
    World world(scene_of(falling(n == 0 ? "single" : "double", 1)));
    const double height = 0.02;
    run(world, 0.2);
    EXPECT_LT(world.ledger().balance_error(), 5e-3);
    plastic[n] = world.ledger().plastic;
    EXPECT_GT(plastic[n], 0.1 * world.ledger().exchanged);
    const BodyModel& body = world.body(0);
    double lost[2] = {0, 0};  // of its height: where it yields, where not
    for (const double x : {-0.0125, 0.0125}) {
      double top = -1, bottom = 1;
      for (const Index node : body.body().nodes()) {
        const Vec3 X = body.body().rest_position(node);
        if (std::abs(X.x() - x) > 1e-4) continue;
        top = std::max(top, body.position(node).z());
        bottom = std::min(bottom, body.position(node).z());
      }
      lost[x > 0 ? 1 : 0] = height - (top - bottom);
    }
    std::printf("lost of its height: %.3g mm where it yields, %.3g mm where not\n", 1e3 * lost[0],
                1e3 * lost[1]);
    EXPECT_GT(lost[0], 0.5e-3);
    EXPECT_GT(lost[0], 2 * std::abs(lost[1]));
    std::vector<Condition> conditions(body.body().nodes().size());
    body.conditions(body.body().nodes(), conditions);
    for (std::size_t m = 0; m < conditions.size(); ++m)
      if (body.body().rest_position(body.body().nodes()[m]).x() > 1e-4) {
        EXPECT_EQ(conditions[m].flags, 0);
        EXPECT_EQ(conditions[m].yielded_share, 0);
      }
  }
  EXPECT_NEAR(plastic[0], plastic[1], 0.01 * plastic[1]);
}

/// Elastic, yielding, broken: a layer that yields first and then tears takes its fracture energy besides.
TEST(Yield, ComesBeforeBreaking) {
  Recipe recipe = solid_box(40, 10, 10, 2.5);
  recipe.body += "\nregions = [{ material = \"weak\", box_min_mm = [0, -9, -9], box_max_mm = [2.5, 9, 9] }]";
  recipe.world = "[material.weak]\n" + recipe.material +
                 "\nyield_ratio = 1.05\nk2_ratio = 0.2\nbreak_ratio = 1.3\nfracture_energy_J_per_m2 = 2\n";
  LedBar bar(recipe);
  double yielded_at = 0, began_at = 0;
  std::int64_t gone = 0;
  while (gone < 16 && bar.moved() < 0.06) {
    gone += bar.step(0.1, 0.1e-3);
    if (yielded_at == 0 && bar.losses().plastic > 0) yielded_at = bar.moved();
    if (began_at == 0 && bar.losses().broken > 0) began_at = bar.moved();
  }
  ASSERT_EQ(gone, 16);
  EXPECT_GT(yielded_at, 0.03 * 0.04);
  EXPECT_GT(began_at, 1.5 * yielded_at);
  EXPECT_GT(bar.losses().plastic, 0);
  std::printf("takes %.4f J/m^2 by breaking, %.4f by yielding, books miss %.5f of the work\n",
              bar.losses().broken / 1e-4, bar.losses().plastic / 1e-4, bar.missing() / bar.work());
  EXPECT_NEAR(bar.losses().broken / 1e-4, 2.0, 0.03 * 2.0);
  EXPECT_LT(std::abs(bar.missing()), 0.01 * bar.work());
  EXPECT_EQ(bar.counts().elements - bar.counts().live_elements, 16);
}

/// A state that is brought back has its shape again, and yields as it did.
TEST(Yield, IsUndoneWithTheStateThatIsBroughtBack) {
  const auto body = make_body_model(body_of(clay_bar(5, "yield_ratio = 1.03\nk2_ratio = 0.1")),
                                    Precision::double_, Integrator::symplectic_euler, {});
  const auto stretch = [&](double by) {
    for (const Index node : body->body().nodes()) {
      const Vec3 X = body->body().rest_position(node);
      body->place(node, Vec3(by * X.x(), -0.4 * by * X.y(), -0.4 * by * X.z()), Vec3::Zero());
    }
    for (int n = 0; n < 5; ++n) body->advance({.dt = 1e-6, .watch = true}, {});
  };
  stretch(0.1);
  const double first = body->losses().plastic;
  ASSERT_GT(first, 0);
  body->save(false), body->save(true);
  const std::uint64_t saved = body->hash(1);
  stretch(0.3);
  const double second = body->losses().plastic;
  EXPECT_GT(second, 2 * first);
  body->restore();
  EXPECT_EQ(body->losses().plastic, first);
  stretch(0.3);
  EXPECT_EQ(body->losses().plastic, second);
  EXPECT_NE(body->hash(1), saved);
  body->reset();
  EXPECT_EQ(body->losses().plastic, 0);
  EXPECT_EQ(body->counts().yielded_masses, 0);
  stretch(0.1);
  EXPECT_EQ(body->losses().plastic, first);
}

}  // namespace
}  // namespace palpate::physics::test
