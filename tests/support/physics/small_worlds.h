#pragma once
// One-line worlds for the tests of the tissue: bodies and scenes from a few words, and masses moved by hand.

#include <functional>
#include <random>
#include <string>

#include "common/math/vec3.h"
#include "common/scene/scene_fwd.h"
#include "physics_node/body/body.h"
#include "physics_node/step/lattice/state.h"

namespace palpate::physics::test {

/// One body and what surrounds it, as text of a scene. Every part can be replaced.
struct Recipe {
  std::string lattice = "fcc";  // empty: a mesh, without spacing
  std::string shape = box(40, 40, 40);
  double spacing_mm = 10;
  std::string material = "mass_g = 1\nk1_N_per_m = 200";
  std::string body = "";   // further keys of [[body]]
  std::string world = "";  // further tables
  std::string precision = "double";
  std::string physics = "";  // further keys of [physics]
  std::string gravity = "[0, 0, 0]";

  static std::string box(double x_mm, double y_mm, double z_mm);
  static std::string sphere(double radius_mm);
};

Scene scene_of(const Recipe& recipe);
Body body_of(const Recipe& recipe);

/// Two masses 1 m apart and the one element that joins them, along (1, 1, 0).
Recipe pair_of_masses(const std::string& material);

/// [floor] and a tool "tip" on a device, as further tables of a scene.
std::string floor_at(double height_mm);
/// It feels planes, so that a ToolState says what it presses with.
std::string point_tool(double radius_mm);

/// A body of tissue that breaks soon.
inline Recipe fragile(const std::string& lattice, const std::string& shape) {
  Recipe recipe;
  recipe.lattice = lattice;
  recipe.shape = shape;
  recipe.material += "\nyield_ratio = 1.1\nbreak_ratio = 1.2";
  return recipe;
}

/// Numbers that are the same on every machine.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double between(double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  Vec3 within(double radius) {
    return {between(-radius, radius), between(-radius, radius), between(-radius, radius)};
  }

 private:
  std::mt19937_64 engine_;
};

template <class Real>
Vec3 read(const Three<Real>& three, Index cell) {
  const auto c = static_cast<std::size_t>(cell);
  return {static_cast<double>(three[0][c]), static_cast<double>(three[1][c]),
          static_cast<double>(three[2][c])};
}

template <class Real>
void write(Three<Real>& three, Index cell, const Vec3& value) {
  for (std::size_t a = 0; a < 3; ++a)
    three[a][static_cast<std::size_t>(cell)] = static_cast<Real>(value[static_cast<Eigen::Index>(a)]);
}

/// Moves every mass to place(rest position).
template <class Real>
void place_masses(const Body& body, LatticeState<Real>& state,
                  const std::function<Vec3(const Vec3&)>& place) {
  for (const Index cell : body.lattice.masses) {
    const Vec3 rest = body.lattice.rest_position(cell);
    write(state.u, cell, place(rest) - rest);
  }
}

/// Gives every free mass a random velocity.
template <class Real>
void shake(const Body& body, LatticeState<Real>& state, double speed, std::uint64_t seed) {
  Dice dice(seed);
  for (const Index cell : body.lattice.masses)
    if (body.inverse_mass[static_cast<std::size_t>(cell)] > 0) write(state.v, cell, dice.within(speed));
}

}  // namespace palpate::physics::test
