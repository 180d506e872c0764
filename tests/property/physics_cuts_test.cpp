// Springs that are cut between two steps: what hangs together after it, and what a cut must not change.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "physics_node/boundary/boundary.h"
#include "physics_node/fragments/fragments.h"
#include "physics_node/step/energy_account.h"
#include "physics_node/step/lattice/stable_step.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics::test {
namespace {

const Vec3 middle(0.0012, 0.0008, -0.0003);  // of the cuts, through no mass [m]
const Vec3 across = Vec3(1, 0.2, 0.1).normalized();

bool is_beyond_cut(const Vec3& p) { return (p - middle).dot(across) > 0; }

Recipe block(const std::string& lattice, const std::string& more = "", double width_mm = 50) {
  Recipe recipe;
  recipe.lattice = lattice;
  recipe.shape = Recipe::box(width_mm, width_mm, width_mm);
  recipe.material += more;
  return recipe;
}

Body body_to_cut(const Recipe& recipe) {
  Body body = body_of(recipe);
  body.may_be_cut = true;
  return body;
}

std::unique_ptr<BodyModel> model_to_cut(const Recipe& recipe,
                                        Integrator integrator = Integrator::symplectic_euler) {
  const Precision precision = recipe.precision == "single" ? Precision::single_ : Precision::double_;
  return make_body_model(body_to_cut(recipe), precision, integrator);
}

std::vector<EdgeGone> live_elements(const BodyModel& moving) {
  std::vector<EdgeGone> live;
  for (const Index a : moving.body().nodes())
    moving.adjacency().each_neighbour(a, [&](Index b) {
      if (a < b) live.push_back({a, b});
    });
  return live;
}

/// The live elements across the plane, their ends now in this order, now in the other.
std::vector<EdgeGone> elements_across(const BodyModel& moving) {
  std::vector<EdgeGone> found;
  for (const EdgeGone& one : live_elements(moving))
    if (is_beyond_cut(moving.body().rest_position(one.a)) !=
        is_beyond_cut(moving.body().rest_position(one.b)))
      found.push_back(found.size() % 2 == 0 ? one : EdgeGone{one.b, one.a});
  return found;
}

double step_of(const Body& body, Integrator integrator) {
  return 0.3 * std::min(1e-3, stable_step(stiffest_mode(body), integrator));
}

/// Longer along x by 4 %, and shaken.
void stretch(BodyModel& moving) {
  Dice dice(7);
  for (const Index node : moving.body().nodes())
    moving.place(node, Vec3(0.04 * moving.body().rest_position(node).x(), 0, 0), dice.within(0.02));
}

struct Case {
  const char* lattice;
  const char* precision;
  Integrator integrator;
  const char* material;
  bool exact;  // books of dampers
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.lattice << " " << c.precision << " " << static_cast<int>(c.integrator)
       << (c.exact ? " exact" : "") << c.material;
}

const char* const elastic = "";
const char* const damped = "\nviscosity_N_s_per_m = 0.02";
const char* const dragged = "\nviscosity_N_s_per_m = 0.02\ndamper = \"relative\"";
const char* const yielding =
    "\nviscosity_N_s_per_m = 0.02\nk2_ratio = 0.3\nyield_ratio = 1.01\nbreak_ratio = 3";

class Cuts : public testing::TestWithParam<Case> {
 protected:
  static Recipe recipe() {
    Recipe recipe = block(GetParam().lattice, GetParam().material);
    recipe.precision = GetParam().precision;
    return recipe;
  }
  void SetUp() override {
    bodies_.push_back(model_to_cut(recipe(), GetParam().integrator));
    if (GetParam().exact) body().prepare_for(Disturbance::impulses);
    dt_ = step_of(body().body(), Integrator::symplectic_euler);
    stretch(body());
    account_.restart(sum_energies(bodies_, Vec3::Zero()), sum_losses_and_due(bodies_), report_);
    advance(15);
  }
  BodyModel& body() { return *bodies_[0]; }
  void advance(int n) {
    const ExplicitStep step{.dt = dt_,
                            .verlet = GetParam().integrator == Integrator::velocity_verlet,
                            .watch = true,
                            .exact = GetParam().exact};
    for (int i = 0; i < n; ++i) report_.tool_work += body().advance(step, {}).work;
  }
  EnergyLedger ledger() const {
    return account_.book(sum_energies(bodies_, Vec3::Zero()), sum_losses_and_due(bodies_), Booked(report_));
  }

  BodyModels bodies_;
  StepReport report_;
  EnergyAccount account_;
  double dt_ = 0;  // [s]
};

TEST_P(Cuts, ChangeNoVelocityAndBookWhatTheElementsHeld) {
  struct Mass {
    Vec3 u, v;
  };
  std::vector<Mass> before;
  for (const Index node : body().body().nodes())
    before.push_back({body().displacement(node), body().velocity(node)});
  const Momenta momenta = body().momenta();
  const double energy = body().energy_now();
  const Losses losses = body().losses();
  const EnergyLedger books = ledger();

  const std::vector<EdgeGone> chosen = elements_across(body());
  ASSERT_GT(chosen.size(), 20u);
  EXPECT_EQ(body().cut(chosen), static_cast<std::int64_t>(chosen.size()));

  for (std::size_t n = 0; n < before.size(); ++n) {
    EXPECT_EQ(body().displacement(body().body().nodes()[n]), before[n].u);
    EXPECT_EQ(body().velocity(body().body().nodes()[n]), before[n].v);
  }
  EXPECT_EQ(body().momenta().linear, momenta.linear);
  EXPECT_EQ(body().momenta().angular, momenta.angular);
  const double broken = body().losses().broken - losses.broken;
  EXPECT_GT(broken, 0.01 * energy);
  EXPECT_NEAR(broken, energy - body().energy_now(), 1e-12 * energy);
  EXPECT_EQ(body().losses().breaks - losses.breaks, static_cast<std::int64_t>(chosen.size()));
  EXPECT_NEAR(ledger().missing(), books.missing(), 1e-12 * books.exchanged);
}

/// As well as without a cut.
TEST_P(Cuts, LeaveBooksThatClose) {
  double missing[2] = {};
  for (const int cut : {0, 1}) {
    bodies_.clear();
    SetUp();
    if (cut == 1) body().cut(elements_across(body()));
    const Momenta start = body().momenta();
    body().restart_momentum();
    for (int n = 0; n < 30; ++n) {
      advance(10);
      missing[cut] = std::max(missing[cut], std::abs(ledger().missing()) / ledger().exchanged);
    }
    const Momenta now = body().momenta();
    double scale = 0;
    for (const Index node : body().body().nodes()) scale += 1e-3 * body().velocity(node).norm();
    const double rounding = std::string(GetParam().precision) == "double" ? 1e-12 : 1e-5;
    // Of backward_euler, to its tolerance.
    const bool solved = GetParam().integrator == Integrator::backward_euler;
    EXPECT_LT((now.linear - start.linear).norm(), (solved ? 1e-5 : rounding) * scale);
    // Central forces turn nothing; Verlet's velocity of whole steps is exact in it to second order only.
    if (GetParam().integrator == Integrator::symplectic_euler && GetParam().material != dragged) {
      EXPECT_LT((now.angular - start.angular).norm(), rounding * scale);
    }
  }
  std::printf("missing %.2g, with a cut %.2g\n", missing[0], missing[1]);
  EXPECT_LT(missing[1], 2 * missing[0] + 1e-5);
}

INSTANTIATE_TEST_SUITE_P(
    EveryBody, Cuts,
    testing::Values(Case{"fcc", "double", Integrator::symplectic_euler, elastic, false},
                    Case{"voxel", "double", Integrator::symplectic_euler, elastic, false},
                    Case{"fcc", "single", Integrator::symplectic_euler, elastic, false},
                    Case{"voxel", "single", Integrator::symplectic_euler, damped, false},
                    Case{"fcc", "double", Integrator::symplectic_euler, damped, true},
                    Case{"voxel", "double", Integrator::symplectic_euler, dragged, true},
                    Case{"fcc", "double", Integrator::velocity_verlet, damped, false},
                    Case{"voxel", "double", Integrator::velocity_verlet, damped, true},
                    Case{"fcc", "double", Integrator::backward_euler, damped, false},
                    Case{"fcc", "double", Integrator::symplectic_euler, yielding, false},
                    Case{"voxel", "double", Integrator::symplectic_euler, yielding, true}));

class CutBodies : public testing::TestWithParam<const char*> {};

TEST_P(CutBodies, FallIntoTwoPieces) {
  const auto moving = model_to_cut(block(GetParam()));
  Fragments fragments(*moving);
  Boundary surface(*moving, 0.04, true);
  moving->advance({.dt = 1e-5}, {});
  moving->advance({.dt = 1e-5}, {});
  ASSERT_FALSE(moving->events().overflow);
  const std::vector<EdgeGone> chosen = elements_across(*moving);
  moving->cut(chosen);
  EXPECT_EQ(moving->events().edges_gone.size(), chosen.size());
  fragments.update(*moving);
  surface.follow();
  surface.update();
  EXPECT_EQ(fragments.count(), 2);
  const Index near = fragments.label(moving->body().nodes().front());
  for (const Index node : moving->body().nodes())
    EXPECT_EQ(fragments.label(node) != near, is_beyond_cut(moving->body().rest_position(node)));
  EXPECT_GT(surface.n_open(), 20u) << "both sides of the cut can be met";
  for (const EdgeGone& one : chosen) {
    EXPECT_FALSE(moving->adjacency().are_joined(one.a, one.b));
    EXPECT_FALSE(moving->adjacency().are_joined(one.b, one.a));
    Condition is;
    moving->conditions({&one.a, 1}, {&is, 1});
    EXPECT_EQ(is.flags, mass_broken);
  }
  EXPECT_EQ(moving->counts().live_elements, moving->counts().elements - moving->breaks());
  moving->advance({.dt = 1e-5}, {});
  EXPECT_TRUE(moving->events().none()) << "nothing of it is told twice";
}

TEST_P(CutBodies, AreNotCutTwiceNorWhereNothingLives) {
  const auto moving = model_to_cut(block(GetParam()));
  stretch(*moving);
  moving->advance({.dt = 1e-5}, {});
  moving->advance({.dt = 1e-5}, {});
  const std::vector<EdgeGone> chosen = elements_across(*moving);
  EXPECT_EQ(moving->cut(chosen), static_cast<std::int64_t>(chosen.size()));
  EXPECT_EQ(moving->breaks(), static_cast<std::int64_t>(chosen.size()));
  const std::uint64_t hash = moving->hash(1);
  const double broken = moving->losses().broken;
  const std::size_t events = moving->events().edges_gone.size();
  EXPECT_EQ(moving->cut(chosen), 0);
  const Index first = moving->body().nodes().front(), last = moving->body().nodes().back();
  const std::vector<EdgeGone> none = {
      {first, first}, {first, last}, {-1, first}, {first, -1},
      {0, first},     {first, 0},    {0, 0},      {moving->body().capacity(), first}};
  EXPECT_EQ(moving->cut(none), 0);
  EXPECT_EQ(moving->hash(1), hash);
  EXPECT_EQ(moving->losses().broken, broken);
  EXPECT_EQ(moving->events().edges_gone.size(), events);
}

TEST_P(CutBodies, AreTheSameOnAnyNumberOfThreads) {
  std::vector<std::uint64_t> hashes;
  for (const int threads : {1, 2, 3, 8}) {
    Recipe recipe = block(GetParam(), damped, 210);
    recipe.precision = "single";
    const auto moving = model_to_cut(recipe);
    ASSERT_GT(moving->body().lattice.chunks.size(), 1u);
    const double dt = step_of(moving->body(), Integrator::symplectic_euler);
    stretch(*moving);
    Team team(threads);
    for (int n = 0; n < 20; ++n) {
      moving->advance({.dt = dt, .team = &team, .threads = threads}, {});
      if (n == 5) moving->cut(elements_across(*moving));
    }
    hashes.push_back(moving->hash(1));
  }
  EXPECT_EQ(hashes, std::vector<std::uint64_t>(4, hashes[0]));
}

TEST_P(CutBodies, AreWholeAgainWhereAStateFromBeforeComesBack) {
  const auto moving = model_to_cut(block(GetParam()));
  const std::uint64_t whole = moving->hash(1);
  const std::vector<EdgeGone> chosen = elements_across(*moving);
  ASSERT_GT(chosen.size(), 8u);
  const std::span<const EdgeGone> some(chosen.data(), 4), others(chosen.data() + 4, 4);
  moving->advance({.dt = 1e-5}, {});
  moving->save(false);
  moving->save(true);
  moving->cut(some);
  moving->restore();
  EXPECT_EQ(moving->breaks(), 0);
  EXPECT_EQ(moving->losses().broken, 0);
  EXPECT_TRUE(moving->events().overflow) << "who follows looks anew";
  EXPECT_EQ(elements_across(*moving).size(), chosen.size());
  // As many as before, but others: what is saved must be these.
  moving->cut(others);
  moving->save(false);
  moving->save(true);
  moving->cut(some);
  moving->restore();
  EXPECT_EQ(moving->breaks(), 4);
  EXPECT_EQ(moving->losses().breaks, 4);
  for (const EdgeGone& one : others) EXPECT_FALSE(moving->adjacency().are_joined(one.a, one.b));
  for (const EdgeGone& one : some) EXPECT_TRUE(moving->adjacency().are_joined(one.a, one.b));
  moving->reset();
  EXPECT_EQ(moving->hash(1), whole);
  EXPECT_EQ(moving->breaks(), 0);
}

/// A body that breaks of itself, too: what was cut is not counted again where the other end hears of a break.
TEST_P(CutBodies, CountEachElementOnce) {
  const auto moving =
      model_to_cut(block(GetParam(), "\nk2_ratio = 0.2\nyield_ratio = 1.05\nbreak_ratio = 1.1"));
  Dice dice(3);
  for (const Index node : moving->body().nodes()) moving->place(node, Vec3::Zero(), dice.within(1.5));
  moving->advance({.dt = 2e-4}, {});
  std::int64_t broke = moving->breaks(), cut = 0;
  for (int n = 0; n < 60; ++n) {
    const std::size_t live = live_elements(*moving).size();
    const std::int64_t gone = moving->advance({.dt = 2e-4}, {}).broken;
    std::vector<EdgeGone> few = elements_across(*moving);
    few.resize(std::min<std::size_t>(few.size(), 3));
    const std::int64_t parted = moving->cut(few);
    EXPECT_EQ(static_cast<std::int64_t>(moving->events().edges_gone.size()), gone + parted);
    EXPECT_EQ(static_cast<std::int64_t>(live - live_elements(*moving).size()), gone + parted);
    broke += gone;
    cut += parted;
  }
  EXPECT_GT(broke, 50);
  EXPECT_GT(cut, 50);
  EXPECT_EQ(moving->breaks(), broke + cut);
  EXPECT_EQ(moving->losses().breaks, broke + cut);
}

TEST_P(CutBodies, AreWokenBesideTheCut) {
  Recipe recipe = block(GetParam());
  recipe.body = "fixed = [\"-z\"]";
  const auto moving = model_to_cut(recipe);
  moving->advance({.dt = 1e-5, .watch = true}, {});
  moving->sleep_and_wake(0.01);
  ASSERT_EQ(moving->sleeping_fraction(), 1);
  const std::vector<EdgeGone> chosen = elements_across(*moving);
  moving->cut({chosen.data(), 1});
  EXPECT_LT(moving->sleeping_fraction(), 1);
}

/// Who has no tool that cuts pays nothing, and who has one is stepped as before until it does.
TEST_P(CutBodies, StepAsOthersDo) {
  const Recipe recipe = block(GetParam(), damped);
  const auto plain = make_body_model(body_of(recipe), Precision::double_);
  const auto moving = model_to_cut(recipe);
  EXPECT_FALSE(any_breaks(plain->body()));
  EXPECT_TRUE(any_breaks(moving->body()));
  EXPECT_FALSE(any_yields(moving->body()));
  EXPECT_EQ(step_of(plain->body(), Integrator::symplectic_euler),
            step_of(moving->body(), Integrator::symplectic_euler));
  for (BodyModel* each : {plain.get(), moving.get()}) {
    stretch(*each);
    for (int n = 0; n < 20; ++n) each->advance({.dt = 1e-4}, {});
  }
  EXPECT_EQ(plain->hash(1), moving->hash(1));
  EXPECT_EQ(plain->cut(elements_across(*plain)), 0);
  EXPECT_EQ(plain->hash(1), moving->hash(1));
}

INSTANTIATE_TEST_SUITE_P(EveryLattice, CutBodies, testing::Values("fcc", "voxel"));

TEST(CutCells, StayAsTheyAre) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 20";
  recipe.body = "model = \"fem\"";
  const auto moving = model_to_cut(recipe);
  EXPECT_FALSE(any_breaks(moving->body()));
  EXPECT_EQ(moving->cut(elements_across(*moving)), 0);
  EXPECT_EQ(moving->breaks(), 0);
}

}  // namespace
}  // namespace palpate::physics::test
