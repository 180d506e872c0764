#include "bench/stress/stress_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "bench/machine/result_folder.h"
#include "bench/problems/settings.h"
#include "bench/problems/stopwatch.h"
#include "common/scene/body_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "physics_node/step/body_model.h"

namespace palpate::bench {
namespace {

struct Energy {
  double held = 0;    // kinetic and elastic
  double fallen = 0;  // work of gravity since rest
};

Energy energy(const physics::World& world) {
  Energy sum;
  for (std::size_t b = 0; b < world.n_bodies(); ++b) {
    const physics::Energies e = world.body(b).energies(world.scene().gravity);
    sum.held += e.kinetic + e.elastic;
    sum.fallen -= e.gravitational;
  }
  return sum;
}

bool all_finite(const physics::World& world) {
  for (std::size_t b = 0; b < world.n_bodies(); ++b) {
    const physics::BodyModel& body = world.body(b);
    for (const physics::Index cell : body.body().lattice.masses)
      if (!body.position(cell).allFinite() || !body.velocity(cell).allFinite()) return false;
  }
  return true;
}

double least_energy(const physics::World& world) {
  double sum = 0;
  for (std::size_t b = 0; b < world.n_bodies(); ++b) {
    const physics::Body& body = world.body(b).body();
    sum += body.solid ? body.solid->modulus * body.lattice.step.prod() * static_cast<double>(body.n_nodes())
                      : body.law.k1[0] * body.lattice.rest_length[0] * body.lattice.rest_length[0] *
                            static_cast<double>(body.lattice.n_elements());
  }
  return 1e-9 * sum;
}

}  // namespace

StressResult run_stress(std::uint64_t seed, ElementModel model,
                        const std::function<void(const std::string&)>& say) {
  const Stopwatch watch;
  const StressScene stress = random_scene(seed, model);
  if (say) say(describe(stress));
  physics::World world(stress.scene);
  set_start(stress, world);
  world.restart_ledger();
  StressResult result;
  result.seed = seed;
  result.integrator = name_of(stress.scene.physics->integrator);
  result.precision = name_of(stress.scene.physics->precision);
  result.lattice = stress.scene.bodies[0].lattice == LatticeKind::fcc ? "fcc" : "voxel";
  result.start = start_names[static_cast<int>(stress.start)];
  result.step_ratio = stress.step_ratio;
  for (std::size_t b = 0; b < world.n_bodies(); ++b) result.masses += world.body(b).body().lattice.n_masses();

  const Energy first = energy(world);
  double most_put_in = first.held + least_energy(world);
  for (int frame = 0; frame < stress.frames; ++frame) {
    const auto hand = tool_at(stress, world, frame);
    world.frame(std::span(&hand, stress.tool_force > 0 ? 1 : 0));
    result.finite = result.finite && all_finite(world);
    const Energy now = energy(world);
    const double tools = world.report().tool_exchange;
    most_put_in = std::max(most_put_in, first.held + now.fallen - first.fallen + tools + least_energy(world));
    const double growth = now.held / most_put_in;
    // A number that is not finite fails the comparison, and so becomes the result.
    if (!(growth <= result.growth)) result.growth = growth;
    if (say)
      say(fmt::format(
          "frame {:3} t {:.4g} s  kinetic + elastic {:.6g} J  gravity {:.6g} J  tools {:.6g} J  growth {:.4g}"
          "  guard {}",
          frame, world.t(), now.held, now.fallen - first.fallen, tools, growth, world.report().restored));
    if (!result.finite) break;
  }
  result.finite = result.finite && std::isfinite(world.ledger().missing());
  result.steps = world.report().steps;
  result.restored = world.report().restored;
  result.diagnosis = world.stopped().value_or("none");
  std::replace(result.diagnosis.begin(), result.diagnosis.end(), ',', ';');
  result.cpu_s = watch.cpu_s();
  return result;
}

const std::vector<std::string>& stress_heading() {
  static const std::vector<std::string> heading = {
      "seed",       "integrator", "lattice", "precision", "start",     "masses", "steps",
      "step_ratio", "finite",     "growth",  "restored",  "diagnosis", "cpu_s"};
  return heading;
}

std::vector<std::string> words(const StressResult& r) {
  return {std::to_string(r.seed),
          r.integrator,
          r.lattice,
          r.precision,
          r.start,
          std::to_string(r.masses),
          std::to_string(r.steps),
          text_of(r.step_ratio),
          r.finite ? "1" : "0",
          text_of(r.growth),
          std::to_string(r.restored),
          r.diagnosis,
          text_of(r.cpu_s)};
}

bool parse(const std::string& line, StressResult& r) {
  std::vector<std::string> w;
  std::stringstream stream(line);
  for (std::string word; std::getline(stream, word, ',');) w.push_back(word);
  if (w.size() != stress_heading().size()) return false;
  r.seed = std::stoull(w[0]);
  r.integrator = w[1], r.lattice = w[2], r.precision = w[3], r.start = w[4];
  r.masses = std::stoll(w[5]), r.steps = std::stoll(w[6]), r.step_ratio = std::stod(w[7]);
  r.finite = w[8] == "1", r.growth = std::stod(w[9]), r.restored = std::stoll(w[10]), r.diagnosis = w[11];
  r.cpu_s = std::stod(w[12]);
  return true;
}

}  // namespace palpate::bench
