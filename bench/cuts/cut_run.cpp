#include "bench/cuts/cut_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "bench/machine/result_folder.h"
#include "bench/problems/stopwatch.h"
#include "common/message/vec3.h"
#include "physics_node/boundary/surface.h"
#include "physics_node/contact/pressing_tool.h"
#include "physics_node/world.h"

namespace palpate::bench {
namespace {

ToolState hand_at(const std::vector<BladePose>& path, std::size_t n) {
  const BladePose& pose = path[n];
  ToolState state;
  state.tick = state.sample = n + 1;
  state.engaged = pose.engaged ? 1 : 0;
  state.stiffness = 1000;
  state.damping = 1;
  state.force_limit = 3;
  state.p_WT = state.proxy = array(pose.tip);
  state.q_WT = {pose.attitude.w(), pose.attitude.x(), pose.attitude.y(), pose.attitude.z()};
  const std::size_t before = std::min<std::size_t>(n, max_told_samples);
  for (std::size_t back = 1; back <= before; ++back)
    for (std::size_t a = 0; a < 3; ++a)
      state.before[back - 1][a] =
          static_cast<float>((path[n - back].tip - pose.tip)[static_cast<Eigen::Index>(a)]);
  state.n_before = static_cast<std::uint32_t>(before);
  return state;
}

double mass_of(const physics::Body& body) {
  double sum = 0;
  body.each_node([&](physics::Index node) { sum += node_mass(body, node); });
  return sum;
}

/// Edges that facets do not go as often one way as the other; of a bag, which a cut opens, those that they go twice one
/// way.
std::int64_t open_edges_of(const physics::BodyModel& moving) {
  const physics::Surface surface = make_surface(moving, std::nullopt, 0);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> gone, ways;
  for (const auto& facet : surface.facets)
    for (std::size_t c = 0; c < 4; ++c) {
      const std::uint32_t a = facet[c], b = facet[(c + 1) % 4];
      if (a != b) gone[std::minmax(a, b)] += a < b ? 1 : -1, ++ways[{a, b}];
    }
  if (is_surface_of_springs(moving.body()))
    return std::ranges::count_if(ways, [](const auto& way) { return way.second > 1; });
  return std::ranges::count_if(gone, [](const auto& edge) { return edge.second != 0; });
}

/// Of the state after each frame.
struct Led {
  std::vector<std::uint64_t> hashes;
  std::size_t last_stroke = 0;  // frames until it cuts; 0: none does
};

Led lead(physics::World& world, const std::vector<BladePose>& path, bool& stays_finite) {
  Led led;
  std::int64_t strokes = world.report().strokes;
  for (std::size_t n = 0; n < path.size(); ++n) {
    const std::optional<ToolState> hand = hand_at(path, n);
    world.frame(std::span(&hand, 1));
    stays_finite = stays_finite && world.body(0).is_finite();
    led.hashes.push_back(world.state_hash());
    if (world.report().strokes > strokes) led.last_stroke = n + 1;
    strokes = world.report().strokes;
  }
  return led;
}

/// @param until  frames that have led to this
bool undoes(physics::World& world, const std::vector<BladePose>& path, std::size_t until) {
  if (until == 0) return !world.undo();
  if (!world.undo()) return false;
  const std::uint64_t late = world.state_hash();
  const double area = world.tool(0).book().cut_area();
  world.reset();
  bool finite = true;
  lead(world, {path.begin(), path.begin() + static_cast<std::ptrdiff_t>(until)}, finite);
  return world.undo() && world.state_hash() == late && world.tool(0).book().cut_area() == area &&
         !world.undo();
}

double share(double part, double whole) { return whole > 0 ? part / whole : part; }

}  // namespace

CutResult run_cuts(CutKind kind, std::uint64_t seed, const std::string& folder) {
  const RandomCuts cuts = random_cuts(kind, seed, folder);
  const Stopwatch watch;
  physics::World world(cuts.scene);
  physics::BodyModel& moving = world.body(0);
  CutResult r;
  r.kind = cut_kinds()[static_cast<std::size_t>(kind)];
  r.seed = seed;
  r.strokes = cuts.strokes;
  r.gives_way = cuts.toughness / cuts.modulus / cuts.edge;
  const double mass = mass_of(moving.body());
  const Led led = lead(world, cuts.path, r.finite);
  const physics::EnergyLedger ledger = world.ledger();
  r.area = world.tool(0).book().cut_area();
  r.opened = moving.breaks();
  moving.body().each_copy([&](physics::Index) { ++r.copies; });
  r.masses = moving.body().n_nodes();
  r.steps = world.report().steps;
  r.mass_off = std::abs(mass_of(moving.body()) - mass) / mass;
  // Where it is held or awake in parts, something else takes momentum up.
  if (!is_anchored(moving.body())) {
    const physics::MomentumBalance balance = moving.momentum_balance();
    r.momentum_off = share(balance.missing.linear.norm(), balance.linear);
    r.angular_off = share(balance.missing.angular.norm(), balance.angular);
  }
  r.balance_error = ledger.balance_error();
  r.cut_off = share(std::abs(ledger.cut - cuts.toughness * r.area), ledger.cut);
  r.least_J = world.report().least_corner_J;
  if (kind != CutKind::springs) r.open_edges = open_edges_of(moving);
  r.restored = world.report().restored;
  r.cpu_s = watch.cpu_s();
  r.undoes = undoes(world, cuts.path, led.last_stroke);
  world.reset();
  bool again_finite = true;
  const Led again = lead(world, cuts.path, again_finite);
  const auto [first, other] = std::ranges::mismatch(led.hashes, again.hashes);
  if (first != led.hashes.end()) r.other_from = first - led.hashes.begin();
  return r;
}

std::string faults(const CutResult& r) {
  std::string all;
  const auto add = [&all](bool is, const std::string& what) {
    if (is) all += (all.empty() ? "" : ", ") + what;
  };
  add(!r.finite, "not finite");
  add(!(r.mass_off <= most_mass_off), fmt::format("mass off by {:.2g}", r.mass_off));
  add(!(std::max(r.momentum_off, r.angular_off) <= most_momentum_off),
      fmt::format("momenta off by {:.2g} and {:.2g}", r.momentum_off, r.angular_off));
  add(!(r.balance_error <= most_balance_error), fmt::format("books off by {:.2g}", r.balance_error));
  add(!(r.cut_off <= most_cut_off), fmt::format("energy.cut off by {:.2g}", r.cut_off));
  add(r.open_edges > 0, fmt::format("{} open edges", r.open_edges));
  add(r.restored > 0, fmt::format("restored {} times", r.restored));
  add(r.other_from >= 0, fmt::format("after a reset other from frame {} on", r.other_from));
  add(!r.undoes, "undone to other bits");
  return all;
}

const std::vector<std::string>& cut_heading() {
  static const std::vector<std::string> heading{
      "kind",    "seed",       "strokes",  "gives_way_cells", "area_mm2",    "opened",        "copies",
      "masses",  "steps",      "mass_off", "momentum_off",    "angular_off", "balance_error", "cut_off",
      "least_J", "open_edges", "restored", "finite",          "other_from",  "undoes",        "cpu_s"};
  return heading;
}

std::vector<std::string> words(const CutResult& r) {
  return {r.kind,
          std::to_string(r.seed),
          std::to_string(r.strokes),
          text_of(r.gives_way),
          text_of(1e6 * r.area),
          std::to_string(r.opened),
          std::to_string(r.copies),
          std::to_string(r.masses),
          std::to_string(r.steps),
          text_of(r.mass_off),
          text_of(r.momentum_off),
          text_of(r.angular_off),
          text_of(r.balance_error),
          text_of(r.cut_off),
          text_of(r.least_J),
          std::to_string(r.open_edges),
          std::to_string(r.restored),
          r.finite ? "1" : "0",
          std::to_string(r.other_from),
          r.undoes ? "1" : "0",
          text_of(r.cpu_s)};
}

}  // namespace palpate::bench
