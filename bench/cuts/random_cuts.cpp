#include "bench/cuts/random_cuts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "bench/problems/block_image.h"
#include "bench/problems/dice.h"
#include "common/scene/load_scene.h"
#include "physics_node/mesh/tet_box.h"
#include "physics_node/mesh/write_msh.h"

namespace palpate::bench {
namespace {

constexpr double frame_s = 1e-3;
constexpr std::size_t most_frames = 400;  // of a stroke
constexpr int let_go_frames = 20;
const Vec3 half(0.012, 0.008, 0.006);  // of the block, round the origin [m]

Eigen::Quaterniond random_turn(Dice& dice) {
  // Why: blades along planes of nodes meet these exactly.
  if (dice.chance(0.4)) {
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
    for (int n = dice.pick(4); n > 0; --n)
      turn = Eigen::AngleAxisd(0.5 * std::numbers::pi, Vec3::Unit(dice.pick(3))) * turn;
    return turn.normalized();
  }
  Vec3 axis = dice.within(1);
  if (axis.norm() < 1e-3) axis = Vec3::UnitX();
  return Eigen::Quaterniond(Eigen::AngleAxisd(dice.between(0, 2 * std::numbers::pi), axis.normalized()));
}

/// Through a point of the block, with part of the edge in it; the edge runs from the tip along +z and goes ahead along -x.
void add_stroke(Dice& dice, double length, double edge, RandomCuts& cuts) {
  const Eigen::Quaterniond turn = random_turn(dice);
  Vec3 through = dice.within(1).cwiseProduct(half);
  if (dice.chance(0.3)) through = edge * (through / edge).array().round().matrix();
  const Vec3 ahead = turn * -Vec3::UnitX(), along = turn * Vec3::UnitZ();
  const Vec3 middle = through - dice.between(0, 1) * length * along;
  const double speed = dice.decades(0.02, 2);
  const double begin = -0.025, end = dice.between(-0.005, 0.025);
  const double back =
      dice.chance(0.3) ? dice.between(begin, end) : end;  // and from there on to the end again
  const double way = (end - begin) + 2 * (end - back);
  const std::size_t n =
      std::clamp<std::size_t>(static_cast<std::size_t>(way / (speed * frame_s)), 2, most_frames);
  const double sway = dice.chance(0.2) ? dice.between(-0.5, 0.5) : 0;  // it turns about its edge meanwhile
  const auto pose = [&](double gone, bool engaged) {
    double at = begin + gone;
    if (const double past = at - end; past > 0) at = back + std::abs(end - past - back);
    const Eigen::Quaterniond swayed(Eigen::AngleAxisd(sway * gone / way, along));
    cuts.path.push_back({middle + at * ahead, swayed * turn, engaged});
  };
  for (int i = 0; i < let_go_frames; ++i) pose(0, false);
  for (std::size_t i = 0; i <= n; ++i) pose(way * static_cast<double>(i) / static_cast<double>(n), true);
  ++cuts.strokes;
}

std::array<int, 3> cells_of_block(double edge) {
  std::array<int, 3> cells;
  for (std::size_t a = 0; a < 3; ++a)
    cells[a] = static_cast<int>(std::lround(2 * half[static_cast<Eigen::Index>(a)] / edge));
  return cells;
}

std::string written_mesh(double edge, std::uint64_t seed, const std::string& folder) {
  physics::TetBox box;
  box.cells = cells_of_block(edge);
  box.edge = edge;
  box.jitter = 0.12;
  box.seed = seed;
  const std::string path = folder + "/block.msh";
  physics::write_msh(path, physics::make_tet_box(box), 0.001);
  return path;
}

std::string written_image(double edge, const std::string& folder) {
  const std::string path = folder + "/block.h5";
  write_block_image(cells_of_block(edge), edge, path);
  return path;
}

std::string box_shape(double edge) {
  return fmt::format("shape = \"box\"\nsize_mm = [{:g}, {:g}, {:g}]\nspacing_mm = {:g}\nat_mm = [0, 0, 0]",
                     2e3 * half.x(), 2e3 * half.y(), 2e3 * half.z(), 1e3 * edge);
}

std::string body_of(CutKind kind, Dice& dice, std::uint64_t seed, double edge, const std::string& folder) {
  // Why half of them: what is free goes out of the blade's way, and only of that all momentum is known.
  const std::string held = dice.chance(0.5) ? "\nfixed = [\"-y\", \"+y\"]" : "";
  const auto mesh = [&](const std::string& keys) {
    return fmt::format("shape = \"mesh\"\nunit = \"mm\"\nfile = \"{}\"\nat_mm = [0, 0, 0]{}\n{}",
                       std::filesystem::absolute(written_mesh(edge, seed, folder)).string(), held, keys);
  };
  switch (kind) {
    case CutKind::tetrahedra:
      return mesh("model = \"fem\"\nelements = \"nodal_pressure\"");
    case CutKind::surfaces: {
      const std::string content = dice.chance(0.5)
                                      ? fmt::format("\npressure_kPa = {:g}\ncontent_modulus_kPa = {:g}",
                                                    dice.decades(0.01, 0.5), dice.decades(1, 50))
                                      : "";
      return mesh(fmt::format("model = \"surface\"\nthickness_mm = {:g}{}", dice.between(0.5, 3), content));
    }
    case CutKind::cells:
      return "model = \"fem\"\nlattice = \"voxel\"\n" + box_shape(edge) + held;
    case CutKind::springs:
      return fmt::format("lattice = \"{}\"\n{}{}", dice.chance(0.5) ? "fcc" : "voxel", box_shape(edge), held);
    case CutKind::parts:
      return fmt::format(
          "model = \"fem\"\nlattice = \"voxel\"\nshape = \"volume\"\nfile = \"{}\"\nkeep = [0, 1000]\nfixed "
          "= [\"-z\"]\n"
          "deformable = {{ awake_mm = {:g} }}",
          std::filesystem::absolute(written_image(edge, folder)).string(), 1e3 * edge * dice.between(4, 6));
  }
  return {};
}

}  // namespace

const std::vector<std::string>& cut_kinds() {
  static const std::vector<std::string> all{"tetrahedra", "cells", "springs", "parts", "surfaces"};
  return all;
}

RandomCuts random_cuts(CutKind kind, std::uint64_t seed, const std::string& folder) {
  Dice dice(seed);
  RandomCuts cuts;
  cuts.edge = dice.chance(0.5) ? 0.002 : 0.001 * dice.between(1.5, 3);
  cuts.toughness = dice.decades(20, 500);
  cuts.modulus = cuts.toughness / (cuts.edge * dice.decades(0.05, 2));
  const double length = dice.between(0.006, 0.024);
  const std::string body = body_of(kind, dice, seed, cuts.edge, folder);
  const bool damped = dice.chance(0.5);
  cuts.scene = parse_scene(
      fmt::format(
          R"(title = "random cuts"
gravity_m_per_s2 = [0, 0, 0]
[physics]
precision = "double"
frame_Hz = 1000
{}
[[body]]
name = "block"
{}
material = "soft"
[material.soft]
density_kg_per_m3 = 1000
modulus_kPa = {:.17g}
{}
cut_toughness_J_per_m2 = {:.17g}
{}
[[tool]]
name = "blade"
shape = "scalpel"
length_mm = {:g}
edge_deg = {:g}
stiffness_N_per_m = {:g}
device = "hand"
[device.hand]
driver = "simulated"
waypoints = [[0, 1000, 0, 0], [1, 1000, 0, 0]]
)",
          // Why: books of an undamped bag err by the square of the step, 4 % by its own; here cuts are looked for.
          kind == CutKind::surfaces && !damped ? "safety = 0.2" : "", body, 1e-3 * cuts.modulus,
          kind == CutKind::springs || kind == CutKind::surfaces ? "" : "poisson_ratio = 0.45", cuts.toughness,
          damped ? fmt::format("viscosity_Pa_s = {:g}", 5e-5 * cuts.modulus) : std::string(), 1e3 * length,
          dice.between(0, 45), dice.decades(200, 2000)),
      "cuts.toml");
  for (int n = 1 + dice.pick(4); n > 0; --n) add_stroke(dice, length, cuts.edge, cuts);
  return cuts;
}

}  // namespace palpate::bench
