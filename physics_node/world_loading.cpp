// Loading: from a scene to bodies, tools, contact and the number of steps in a frame.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include "common/error/error.h"
#include "common/scene/body_spec.h"
#include "common/scene/connection_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "common/scene/surroundings_spec.h"
#include "common/scene/tool_spec.h"
#include "physics_node/forecast/integrator_choice.h"
#include "physics_node/forecast/memory_need.h"
#include "physics_node/forecast/speed_forecast.h"
#include "physics_node/step/lattice/fast_choice.h"
#include "physics_node/step/lattice/stable_step.h"
#include "physics_node/step/multigrid/start_of_body.h"
#include "physics_node/world.h"

namespace palpate::physics {
namespace {

constexpr Index masses_worth_a_team = 15000;  // below, a second thread brings little (palpate bench team)

/// May anything touch bodies?
bool may_touch(const Scene& scene) {
  return scene.floor || !scene.walls.empty() || !scene.tools.empty() ||
         (scene.contact->enabled && scene.bodies.size() > 1);
}

/// backward_euler solves springs on one thread, finite elements on as many as there are.
bool solves_springs(const Scene& scene) {
  return scene.physics->integrator == Integrator::backward_euler &&
         std::ranges::none_of(scene.bodies,
                              [](const BodySpec& body) { return body.model == ElementModel::fem; });
}

/// @param n_pieces  of the body that has most: more threads than that would have nothing to do
TeamChoice choose_threads(const Scene& scene, int spare_cores, Index n_masses, std::size_t n_pieces) {
  if (scene.physics->threads > 0) return TeamChoice::always(scene.physics->threads);
  if (n_masses < masses_worth_a_team || solves_springs(scene)) return TeamChoice::always(1);
  const int cores = static_cast<int>(std::thread::hardware_concurrency()) - spare_cores;
  return TeamChoice::up_to(std::clamp(cores, 1, std::max(1, static_cast<int>(n_pieces))));
}

/// By node, as large as they may become when a body is cut: of its lightest tetrahedron, triangle or cell alone [1/kg].
std::vector<double> inverse_masses_when_cut(const Body& body) {
  std::vector<double> inverse = body.inverse_mass;
  if (const CellNet* net = body.cell_net())
    for (const Index cell : net->cells())
      for (const Index node : net->loaded_corners(cell))
        if (double& w = inverse[static_cast<std::size_t>(node)]; w > 0)
          w = std::max(w, 1 / body.solid->eighth[static_cast<std::size_t>(cell)]);
  if (body.mesh && body.mesh->triangles) {
    const SpringSurface& surface = *body.mesh->springs;
    for (const MeshTriangle& t : surface.mesh.triangles) {
      const double third = mass_share(surface.membrane, area_of(surface.mesh, t));
      for (const Index node : t)
        if (double& w = inverse[static_cast<std::size_t>(node)]; w > 0) w = std::max(w, 1 / third);
    }
  }
  if (!body.mesh || !body.mesh->net) return inverse;
  const TetModel& model = body.mesh->model;
  for (std::size_t t = 0; t < model.mesh.tets.size(); ++t) {
    const TetMaterial& material = model.materials[static_cast<std::size_t>(model.mesh.region[t])];
    const double quarter = material.density * signed_volume(model.mesh, model.mesh.tets[t]) / 4;
    for (const Index node : model.mesh.tets[t])
      if (double& w = inverse[static_cast<std::size_t>(node)]; w > 0) w = std::max(w, 1 / quarter);
  }
  return inverse;
}

/// What strands add to the largest squared frequency of a body, and to the rate of its dampers.
struct Joined {
  double omega2 = 0, rate = 0;  // [1/s^2], [1/s]
  void add(const Joined& other) noexcept { omega2 += other.omega2, rate += other.rate; }
};

/// Of a sum at most the sum: dt^2 w^2 / 4 + dt D <= 1, with 2 D the rate of dampers that act by the velocity before. [s]
double stable_when_joined(double alone, const Joined& by) noexcept {
  if (by.omega2 == 0 && by.rate == 0) return alone;
  const double quarter = 1 / (alone * alone) + by.omega2 / 4, half = by.rate / 2;
  return (std::sqrt(half * half + 4 * quarter) - half) / (2 * quarter);
}

// Elements that act for S steps at once shake what strands pull at meanwhile, by (S dt w)^2 / 4 of what these
// hold, w their frequency at a foot: 1 % at most.
constexpr double shakes = 0.2, unbounded = std::numeric_limits<double>::infinity();

/// May its elements act for several steps at once?
bool may_stride(const Body& body) { return body.mesh && is_of_finite_elements(body); }

/// Refuses what would take more memory than there is before it takes it. @throws InputError
std::vector<Body> build_bodies(const Scene& scene) {
  const double memory = usable_memory();
  std::vector<MemoryNeed> needs;
  for (const BodySpec& spec : scene.bodies) needs.push_back(memory_need(spec, scene));
  refuse_too_large(scene, needs, memory);
  std::vector<Body> built;
  for (const BodySpec& spec : scene.bodies) {
    built.push_back(build_body(spec, scene.materials));
    MemoryNeed& need = needs[built.size() - 1];
    if (need.masses != 0) continue;
    need.masses = static_cast<double>(built.back().n_nodes());  // of an image: now it is known
    need.bytes += bytes_of_masses(need.masses, spec, scene);
    refuse_too_large(scene, needs, memory);
  }
  return built;
}

/// Can what a scene has meet each other, or itself where it breaks? A body that is awake in parts is alone, and its parts do not.
bool may_collide(const BodyModels& bodies) {
  return bodies.size() > 1 || std::ranges::any_of(bodies, [](const auto& body) {
           return may_come_apart(body->body()) && !is_awake_in_parts(body->body());
         });
}

/// What rests of a body that is awake in parts cannot be met: it is alone but for tools that are no bodies.
void refuse_company(const Scene& scene, const std::vector<Body>& built) {
  for (std::size_t b = 0; b < built.size(); ++b)
    if (is_awake_in_parts(built[b]) && built.size() > 1)
      throw InputError(
          fmt::format("{}: body \"{}\" has awake_mm, and there is another, \"{}\": only tools that are no "
                      "bodies touch it; leave that out, or write deformable = \"all\"",
                      scene.bodies[b].place.text(), built[b].name, built[b == 0 ? 1 : 0].name));
}

}  // namespace

World::World(const Scene& scene, int spare_cores) : scene_(scene) {
  std::vector<Body> built = build_bodies(scene);
  refuse_company(scene, built);
  if (std::ranges::any_of(scene.tools, cuts))
    for (std::size_t b = 0; b < built.size(); ++b)
      make_ready_for_cuts(scene.bodies[b], scene.materials, built[b]);
  const Integrator integrator = settle_steps(built);
  Index n_masses = 0;
  std::size_t n_pieces = 0;
  if (scene.floor) planes_.push_back({Vec3::UnitZ(), scene.floor->height});
  for (const WallSpec& wall : scene.walls) planes_.push_back({wall.normal, wall.normal.dot(wall.point)});
  const bool feels = std::any_of(scene.tools.begin(), scene.tools.end(), meets_facets);
  for (Body& body : built) {
    const BodySpec& spec = scene.bodies[bodies_.size()];
    n_masses += body.n_nodes();
    n_pieces = std::max(n_pieces, body.n_pieces());
    any_breaks_ = any_breaks_ || may_come_apart(body);
    const double bucket = 4 * body.spacing();
    std::vector<Vec3> start = start_of_body(spec, body, scene.gravity, planes_, remarks_);
    bodies_.push_back(
        make_body_model(std::move(body), scene.physics->precision, integrator, std::move(start)));
    fragments_.push_back(may_come_apart(bodies_.back()->body()) ? std::make_unique<Fragments>(*bodies_.back())
                                                                : nullptr);
    touchable_.push_back({bodies_.back().get(), std::make_unique<Boundary>(*bodies_.back(), bucket, feels)});
  }
  join_bodies();
  toolbox_ = make_tools(scene_, bodies_, touchable_, connections_);
  if (std::ranges::any_of(scene.tools, cuts)) {
    books_between_.resize(toolbox_.tools.size());
    books_before_ = books_between_;
  }
  if (scene.contact->enabled && may_collide(bodies_))
    collisions_ = std::make_unique<Collisions>(bodies_, fragments_, *scene.contact);
  if (collisions_)
    for (const std::size_t b : toolbox_.felt) collisions_->feel(b);
  if (bodies_.size() > 1 || any_breaks_) inside_ = std::make_unique<InsideOthers>(bodies_);
  if (!planes_.empty())
    for (auto& body : bodies_) body->prepare_for(Disturbance::impulses);
  choice_ = choose_threads(scene_, spare_cores, n_masses, n_pieces);
  if (choice_.most() > 1) team_ = std::make_unique<Team>(choice_.most());
  gathered_.resize(bodies_.size());
  for (auto& forces : gathered_) forces.reserve(toolbox_.pressing.size() * PointTool::most_forces);

  frame_dt_ = 1.0 / scene.physics->frame_Hz;
  n_substeps_ = static_cast<int>(steps_a_frame(scene_, stable_dt_));
  settle_strides();
  unrounded_ = std::min(1.0, frame_dt_ / (scene.physics->safety * stable_dt_) / n_substeps_);
  dt_ = frame_dt_ / n_substeps_;
  constexpr double rounding = 1e-9;  // that steps_a_frame() allows
  if (dt_ > (1 + rounding) * stable_dt_) {
    remarks_.push_back(fmt::format(
        "{}: a step of {:.4g} ms is above the stable {:.4g} ms; expect the guard to act",
        scene.physics->place.line == 0 && scene.physics->place.file.empty() ? scene.path + ": [physics]"
                                                                            : scene.physics->place.text(),
        1e3 * dt_, 1e3 * stable_dt_));
  }
  restart_ledger();
}

void World::settle_strides() {
  // Why not of a given step: who gives one wants it of all.
  const bool explicit_euler =
      scene_.physics->integrator == Integrator::symplectic_euler && !scene_.physics->step;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const bool may = explicit_euler && may_stride(bodies_[b]->body());
    strides_.add(may ? std::min(scene_.physics->safety * stable_alone_[b], unshaken_[b]) : 0.0,
                 static_cast<double>(bodies_[b]->body().n_elements()));
  }
  strides_.share(n_substeps_, frame_dt_);
  n_substeps_ = strides_.shared(n_substeps_);
}

void World::join_bodies() {
  const auto number = [this](const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(scene_.bodies, name, &BodySpec::name) -
                                    scene_.bodies.begin());
  };
  std::vector<Joined> joined(bodies_.size());
  std::vector<double> pulls(
      bodies_.size());  // the same of masses as loaded, which a cut makes lighter [1/s^2]
  Joined any;
  for (const ConnectionSpec& spec : scene_.connections) {
    const std::size_t from = number(spec.from), to = number(spec.to);
    const auto surface = [this](std::size_t b) {
      return on_masses(bodies_[b]->body(), surface_as_loaded(b));
    };
    auto strands = make_strands(spec, surface(from), surface(to));
    if (strands.empty())
      throw InputError(
          fmt::format("{}: connection \"{}\" joins nothing: no moving place of \"{}\" lies within {:.4g} mm "
                      "of \"{}\"; write a "
                      "larger within_mm, or bring them nearer",
                      spec.place.text(), spec.name, spec.from, 1e3 * spec.within, spec.to));
    const auto of_from = inverse_masses_when_cut(bodies_[from]->body());
    const auto of_to = inverse_masses_when_cut(bodies_[to]->body());
    const Joined at_from{added_omega2(strands, 0, of_from), added_rate(strands, 0, of_from)};
    const Joined at_to{added_omega2(strands, 1, of_to), added_rate(strands, 1, of_to)};
    joined[from].add(at_from), joined[to].add(at_to);
    pulls[from] += added_omega2(strands, 0, bodies_[from]->body().inverse_mass);
    pulls[to] += added_omega2(strands, 1, bodies_[to]->body().inverse_mass);
    any.add({std::max(at_from.omega2, at_to.omega2), std::max(at_from.rate, at_to.rate)});
    connections_.push_back(std::make_unique<Connection>(std::move(strands), *bodies_[from], *bodies_[to]));
  }
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    stable_alone_[b] = stable_when_joined(stable_alone_[b], joined[b]);
    unshaken_.push_back(pulls[b] > 0 ? shakes / std::sqrt(pulls[b]) : unbounded);
  }
  if (connections_.empty()) return;
  const double unjoined = stable_dt_, shortest = 1 / (scene_.physics->frame_Hz * most_steps_a_frame);
  stable_dt_ = stable_when_joined(stable_dt_, any);
  const double safety = scene_.physics->safety;
  if (safety * stable_dt_ < shortest && safety * unjoined >= shortest && !scene_.physics->step)
    throw InputError(fmt::format(
        "{}: strands so stiff or viscous want a step of {:.2g} s, where a frame has at most {:g}; give "
        "connection \"{}\" a smaller modulus_kPa or viscosity_Pa_s",
        scene_.connections.front().place.text(), safety * stable_dt_, most_steps_a_frame,
        scene_.connections.front().name));
}

Integrator World::settle_steps(std::vector<Body>& built) {
  Integrator& integrator = scene_.physics->integrator;
  if (integrator == Integrator::automatic) {
    double dt = std::numeric_limits<double>::infinity();
    for (const Body& body : built)
      dt = std::min(dt, stable_step(stiffest_mode(body), Integrator::symplectic_euler));
    IntegratorChoice choice = choose_integrator(scene_, dt);
    integrator = choice.integrator;
    if (!choice.remark.empty()) remarks_.push_back(std::move(choice.remark));
  }
  stable_dt_ = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < built.size(); ++b) {
    stable_alone_.push_back(settle_step(scene_.bodies[b], built[b], scene_, may_touch(scene_), remarks_));
    stable_dt_ = std::min(stable_dt_, stable_alone_.back());
  }
  return integrator;
}

}  // namespace palpate::physics
