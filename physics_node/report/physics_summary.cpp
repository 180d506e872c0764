#include "physics_node/report/physics_summary.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "common/math/hash.h"
#include "common/report/commit.h"
#include "common/report/warnings.h"
#include "common/scene/body_spec.h"
#include "common/scene/connection_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "common/scene/surroundings_spec.h"
#include "common/scene/tool_spec.h"
#include "physics_node/body/kept_momentum.h"
#include "physics_node/fragments/outcome.h"
#include "physics_node/report/run_warnings.h"

namespace palpate::physics {
namespace {

nlohmann::json triple(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

nlohmann::json body_part(const BodyModel& moving, const Fragments* fragments) {
  const BodyCounts counts = moving.counts();
  const auto n_masses = static_cast<double>(moving.body().n_nodes());
  const auto elements = static_cast<double>(std::max<std::int64_t>(counts.elements, 1));
  nlohmann::json part = {{"masses", moving.body().n_nodes()},
                         {"held_masses", moving.body().n_held},
                         {"elements", counts.elements},
                         {"live_elements", counts.live_elements},
                         {"broken_fraction", 1.0 - static_cast<double>(counts.live_elements) / elements},
                         {"max_stretch", counts.max_stretch},
                         {"shape_rms_m", counts.shape_rms},
                         {"sleeping_fraction", moving.sleeping_fraction()}};
  if (counts.least_corner_J) part["min_corner_J"] = *counts.least_corner_J;
  if (may_change_for_good(moving.body()))
    part["yielded_fraction"] = static_cast<double>(counts.yielded_masses) / n_masses;
  const OutcomeMeasures measures = measure_outcome(moving, fragments, counts);
  part["outcome"] = name_of(classify(measures));
  if (fragments != nullptr) {
    part["fragments"] = measures.fragments;
    part["largest_fragment"] = measures.largest;
    if (measures.fragments > 1) part["second_fragment"] = measures.second;
  }
  if (moving.body().cells) {
    part["voxels"] = moving.body().cells->n_filled();
    part["deformable_voxels"] = moving.body().cells->n_deformable();
  }
  return part;
}

/// Of the box round a body at rest, half of its diagonal [m].
double size_of(const Body& body) {
  Eigen::AlignedBox3d box;
  for (const Index node : body.nodes()) box.extend(body.rest_position(node));
  return 0.5 * box.diagonal().norm();
}

/// By how much the momenta differ from what was put in; only where all bodies are free.
void add_momentum_errors(const World& world, nlohmann::json& part) {
  MomentumBalance sum;
  for (std::size_t b = 0; b < world.n_bodies(); ++b) {
    if (!keeps_momentum(world.body(b).body())) return;
    const MomentumBalance one = world.body(b).momentum_balance();
    sum.missing.linear += one.missing.linear;
    sum.missing.angular += one.missing.angular;
    sum.linear += one.linear;
    // Why not of what turns alone: a body that falls by the origin has next to no moment, and that may not make digits errors.
    sum.angular += one.angular + one.linear * size_of(world.body(b).body());
  }
  part["linear_error"] = sum.linear > 0 ? sum.missing.linear.norm() / sum.linear : 0.0;
  part["angular_error"] = sum.angular > 0 ? sum.missing.angular.norm() / sum.angular : 0.0;
}

nlohmann::json energy_part(const EnergyLedger& ledger) {
  return {{"kinetic", ledger.kinetic},
          {"elastic", ledger.elastic},
          {"dissipated", ledger.dissipated},
          {"gravitational", ledger.gravitational},
          {"plastic", ledger.plastic},
          {"broken", ledger.broken},
          {"tool_work", ledger.tool_work},
          {"guard", ledger.guard},
          {"contact", ledger.contact},
          {"cut", ledger.cut},
          {"numerical", ledger.numerical},
          {"exchanged", ledger.exchanged},
          {"balance_error", ledger.balance_error()}};
}

/// Depends on the machine and on what else it does; nothing else here but times does.
nlohmann::json team_part(const TeamChoice& choice) {
  return {
      {"mean_threads", choice.mean_threads()}, {"trials", choice.trials()}, {"changes", choice.changes()}};
}

/// What the hand felt, and whether tissue bore it.
nlohmann::json touch_part(const Tool& tool, const Scene& scene) {
  nlohmann::json part = {{"hand_work", tool.book().hand_work()}};
  if (tool.knows_tissue_work()) part["tissue_work"] = tool.book().tissue_work();
  if (tool.book().punctures() > 0) {
    part["punctures"] = tool.book().punctures();
    part["puncture_force"] = tool.book().puncture_force();
    part["deepest_mm"] = 1e3 * tool.book().deepest();
    part["shaft_friction_work"] = tool.book().rubbed();
  }
  if (tool.book().cut_area() > 0) {
    part["cut_area_mm2"] = 1e6 * tool.book().cut_area();
    part["cut_work"] = tool.book().cut_work();
  }
  if (tool.book().handle_torque() > 0) {
    part["handle_torque_peak"] = tool.book().handle_torque();
    part["handle_work"] = tool.book().handle_work();
  }
  const auto passed = tool.book().passed_unfelt();
  for (std::size_t b = 0; b < passed.size(); ++b)
    if (passed[b] > 0) part["passed_unfelt_mm2"][scene.bodies[b].name] = 1e6 * passed[b];
  if (const auto ratio = tool.book().felt_over_true_rms()) part["felt_over_true_rms"] = *ratio;
  if (const auto off = tool.book().felt_off_rms()) part["felt_off_rms"] = *off;
  return part;
}

nlohmann::json stages_part(const StepReport& report) {
  nlohmann::json part;
  for (std::size_t s = 0; s < n_stages; ++s) {
    const StageTime& time = report.stages[s];
    part[stage_names[s]] = {{"total_s", 1e-9 * static_cast<double>(time.total_ns)},
                            {"calls", time.calls},
                            {"skipped", time.skipped}};
  }
  return part;
}

const char* integrator_name(Integrator integrator) {
  constexpr const char* names[] = {"symplectic_euler", "velocity_verlet", "backward_euler"};
  return names[static_cast<int>(integrator)];
}

const char* precision_name(Precision precision) {
  return precision == Precision::single_ ? "single" : "double";
}

}  // namespace

nlohmann::json physics_summary(const World& world, const Recorder* recorder, double wall_s, double began_t) {
  const Scene& scene = world.scene();
  nlohmann::json part = {{"scene", scene.path},
                         {"title", scene.title},
                         {"scene_checksum", hex_of(scene.checksum)},
                         {"commit", commit()},
                         {"seed", scene.seed},
                         {"threads", world.threads()},
                         {"team", team_part(world.team_choice())},
                         {"precision", precision_name(scene.physics->precision)},
                         {"integrator", integrator_name(scene.physics->integrator)},
                         {"simulated_s", world.t()},
                         {"wall_s", wall_s},
                         {"real_time_factor", wall_s > 0 ? (world.t() - began_t) / wall_s : 0.0},
                         {"steps", world.report().steps},
                         {"dt_s", world.step_seconds()},
                         {"state_hash", hex_of(world.state_hash())},
                         {"stages", stages_part(world.report())}};
  if (began_t > 0) part["began_s"] = began_t;
  if (std::isfinite(world.stable_step_seconds())) part["stable_dt_s"] = world.stable_step_seconds();
  std::optional<InsideOthers> inside;
  if (world.inside_others() != nullptr) {
    inside = *world.inside_others();
    inside->look();
  }
  Momenta momenta;
  for (std::size_t b = 0; b < world.n_bodies(); ++b) {
    const BodyModel& moving = world.body(b);
    part["bodies"][moving.body().name] = body_part(moving, world.fragments(b));
    nlohmann::json& of_body = part["bodies"][moving.body().name];
    of_body["steps"] = world.steps_of_body(b);
    if (world.n_bodies() > 1) {
      of_body["inside_others"] = inside->now(b);
      of_body["inside_others_max"] = inside->most(b);
    }
    if (world.fragments(b) != nullptr)
      of_body["inside_own_pieces"] = inside->between_pieces(b, *world.fragments(b));
    const Momenta p = moving.momenta();
    momenta.linear += p.linear;
    momenta.angular += p.angular;
  }
  part["energy"] = energy_part(world.ledger());
  part["momentum"] = {{"linear", triple(momenta.linear)}, {"angular", triple(momenta.angular)}};
  add_momentum_errors(world, part["momentum"]);
  part["guard"] = {{"nonfinite", world.report().nonfinite},
                   {"grown", world.report().grown},
                   {"restored", world.report().restored},
                   {"halved", world.report().halved},
                   {"unsolved", world.report().unsolved}};
  if (std::ranges::any_of(world.scene().tools, cuts))
    part["strokes"] = {{"begun", world.report().strokes}, {"undone", world.report().undone}};
  if (const auto why = world.stopped()) part["guard"]["stopped"] = *why;
  if (const Collisions* collisions = world.collisions()) {
    const CollisionTally& tally = collisions->tally();
    part["contact"] = {{"candidates", collisions->n_candidates()},
                       {"collisions", tally.collisions},
                       {"stopped", tally.stopped},
                       {"overflows", tally.overflows},
                       {"rebuilds", tally.rebuilds}};
    if (scene.contact->count_passages) part["contact"]["passages"] = tally.passages;
  }
  for (std::size_t n = 0; n < world.n_connections(); ++n)
    part["connections"][scene.connections[n].name] = {{"strands", world.connection(n).n_strands()},
                                                      {"torn", world.connection(n).n_torn()},
                                                      {"cut", world.connection(n).n_cut()},
                                                      {"pull", world.connection(n).pull()}};
  for (std::size_t n = 0; n < world.n_tools(); ++n)
    part["tools"][scene.tools[n].name] = touch_part(world.tool(n), scene);
  for (std::size_t n = 0; recorder != nullptr && n < scene.tools.size(); ++n)
    part["tools"][scene.tools[n].name].update({{"contacts_max", recorder->contacts_max(n)},
                                               {"force_peak", recorder->force_peak(n)},
                                               {"force_rms", recorder->force_rms(n)},
                                               {"moment_peak", recorder->moment_peak(n)},
                                               {"trace", Recorder::trace_name(scene.tools[n].name)}});
  if (recorder != nullptr) part["record"] = {{"dropped", recorder->dropped()}};
  part["warnings"] = nlohmann::json::array();
  add_warnings(part, all_warnings(world));
  if (inside && inside->any() && !world.inside_others()->any())
    add_warning(part, inside_text(world, *inside));
  count_warnings(part);
  return part;
}

}  // namespace palpate::physics
