// A body of tetrahedra that comes apart is the body that its mesh has become, and loses nothing by it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "physics_node/step/fem/tet_spectrum.h"
#include "tests/unit/physics_node/step/fem/tet_bodies.h"

namespace palpate::physics {
namespace {

using test::expect_momenta_kept;
using test::model_of;
using test::stir;
using test::TetCube;

constexpr std::size_t plenty = 5000;

struct Parting {
  bool nodal = false, damped = false, two_materials = false;
};
std::string parting_name(const testing::TestParamInfo<Parting>& info) {
  return std::string(info.param.nodal ? "Nodal" : "Plain") + (info.param.damped ? "Damped" : "") +
         (info.param.two_materials ? "TwoMaterials" : "");
}

TetModel model_for(const Parting& p, bool held = false) {
  return model_of({.cells = {6, 4, 4},
                   .nodal = p.nodal,
                   .beta = p.damped ? 1e-4 : 0.0,
                   .held = held,
                   .two_materials = p.two_materials});
}

/// The plane across x through the middle, then some at random.
void open_some(TetNet& net, const TetModel& model, bool at_random) {
  std::mt19937 random(7 + static_cast<unsigned>(net.n_copies()));
  const auto right = [&](Index t) {
    double x = 0;
    for (const Index node : model.mesh.tets[static_cast<std::size_t>(t)])
      x += model.mesh.nodes[static_cast<std::size_t>(net.origin(node))].x() / 4;
    return x > 0.0075;
  };
  for (Index t = 0; t < net.n_elements(); ++t)
    for (std::size_t f = 0; f < 4; ++f) {
      const Index u = net.beyond(t, f);
      if (u > t && (at_random ? random() % 4 == 0 : right(t) != right(u))) net.open(t, u);
    }
}

template <class Real>
struct PartedBody {
  explicit PartedBody(const Parting& p, bool held = false)
      : model(model_for(p, held)),
        net(model.mesh.tets, model.mesh.nodes.size(), plenty),
        tets(model, instruction_set(), plenty) {}
  double part(bool at_random) {
    net.begin();
    open_some(net, model, at_random);
    return tets.separate(net.splits(), net);
  }

  TetModel model;
  TetNet net;
  Tetrahedra<Real> tets;
};

/// A body of the mesh that another has become, where that is and as fast.
template <class Real>
Tetrahedra<Real> made_anew(const Tetrahedra<Real>& from) {
  Tetrahedra<Real> anew(from.model());
  for (Index n = 0; n < static_cast<Index>(from.n_nodes()); ++n)
    anew.place(n, from.displacement(n), from.velocity(n));
  return anew;
}

class Partings : public testing::TestWithParam<Parting> {};
INSTANTIATE_TEST_SUITE_P(All, Partings,
                         testing::Values(Parting{}, Parting{.nodal = true},
                                         Parting{.nodal = true, .damped = true},
                                         Parting{.nodal = true, .damped = true, .two_materials = true},
                                         Parting{.damped = true}),
                         parting_name);

TEST_P(Partings, KeepMassMomentumAndPlaces) {
  PartedBody<double> body(GetParam());
  stir(body.tets, 0.0004, 0.2);
  double before = 0, after = 0;
  for (const double mass : masses_of(body.tets.model())) before += mass;
  expect_momenta_kept(body.tets, [&] { body.part(false), body.part(true); });
  EXPECT_GT(body.net.n_copies(), 100);
  for (Index n = 0; n < body.net.n_nodes(); ++n) {
    after += body.tets.mass(n, body.net);
    EXPECT_NEAR(1 / body.tets.inverse_mass(n), body.tets.mass(n, body.net),
                1e-15 * body.tets.mass(n, body.net));
    const Index origin = body.net.origin(n);
    EXPECT_EQ(body.tets.displacement(n), body.tets.displacement(origin));
    EXPECT_EQ(body.tets.velocity(n), body.tets.velocity(origin));
  }
  EXPECT_NEAR(after, before, 1e-14 * before);
}

TEST_P(Partings, GrowByAsMuchEnergyAsTheySay) {
  PartedBody<double> body(GetParam());
  stir(body.tets, 0.0004, 0.2);
  for (const bool at_random : {false, true}) {
    const Energies before = body.tets.energies(Vec3::Zero());
    const double grown = body.part(at_random);
    const Energies after = body.tets.energies(Vec3::Zero());
    EXPECT_NEAR(after.kinetic, before.kinetic, 1e-13 * before.kinetic);
    EXPECT_NEAR(after.elastic - before.elastic, grown, 1e-12 * before.elastic);
    if (GetParam().nodal)
      EXPECT_GT(grown, 0);
    else
      EXPECT_EQ(grown, 0);
  }
}

/// In forces, and in what they make of it by and by.
TEST_P(Partings, AreTheBodyOfTheMeshThatTheyHaveBecome) {
  PartedBody<double> body(GetParam());
  stir(body.tets, 0.0002, 0.2);
  for (const bool at_random : {false, true}) {
    body.part(at_random);
    Tetrahedra<double> anew = made_anew(body.tets);
    std::vector<Vec3> f(body.tets.n_nodes()), of_anew(f.size());
    body.tets.forces(f);
    anew.forces(of_anew);
    double most = 0, apart = 0;
    for (std::size_t n = 0; n < f.size(); ++n)
      most = std::max(most, f[n].norm()), apart = std::max(apart, (f[n] - of_anew[n]).norm());
    EXPECT_LT(apart, 1e-12 * most);
    for (int n = 0; n < 40; ++n) body.tets.step({.dt = 2e-5}), anew.step({.dt = 2e-5});
    double moved = 0, differ = 0;
    for (Index n = 0; n < static_cast<Index>(f.size()); ++n) {
      moved = std::max(moved, body.tets.displacement(n).norm());
      differ = std::max(differ, (body.tets.displacement(n) - anew.displacement(n)).norm());
    }
    EXPECT_LT(differ, 1e-10 * moved);
  }
}

TEST_P(Partings, JoinAgainToTheSameBits) {
  PartedBody<float> body(GetParam()), whole(GetParam());
  stir(body.tets, 0.0002, 0.2), stir(whole.tets, 0.0002, 0.2);
  body.part(false), body.part(true);
  body.tets.rejoin();
  for (int n = 0; n < 20; ++n) body.tets.step({.dt = 2e-5}), whole.tets.step({.dt = 2e-5});
  EXPECT_EQ(body.tets.hash(1), whole.tets.hash(1));
}

TEST_P(Partings, HoldOnByCopiesOfWhatIsHeld) {
  PartedBody<double> body(GetParam(), true);
  body.part(true);
  int held = 0;
  for (int n = 0; n < 20; ++n) body.tets.step({.dt = 2e-5, .gravity = Vec3(0, 0, -9.81)});
  for (Index n = body.net.n_loaded(); n < body.net.n_nodes(); ++n) {
    if (body.tets.inverse_mass(body.net.origin(n)) > 0) continue;
    EXPECT_EQ(body.tets.inverse_mass(n), 0);
    EXPECT_EQ(body.tets.displacement(n), Vec3::Zero().eval());
    ++held;
  }
  EXPECT_GT(held, 0);
}

/// With the step that the bound of the elements allows, opened more and more.
TEST_P(Partings, StayStableWithTheStepChosenBefore) {
  PartedBody<double> body(GetParam());
  const double omega2 = stiffest_mode_when_cut(body.model).omega2;
  const double dt = 0.97 * stable_step({omega2, body.model.beta * omega2}, Integrator::symplectic_euler);
  stir(body.tets, 1e-6, 0);
  const double start = body.tets.energies(Vec3::Zero()).elastic;
  double most = 0;
  for (int n = 0; n < 2000; ++n) {
    body.tets.step({.dt = dt});
    if (n % 500 == 250) body.part(true);
    const Energies now = body.tets.energies(Vec3::Zero());
    most = std::max(most, now.elastic + now.kinetic);
  }
  EXPECT_LT(most, 40 * start) << "near the limit leapfrog swings by 1 / (1 - (w dt / 2)^2)";
}

}  // namespace
}  // namespace palpate::physics
