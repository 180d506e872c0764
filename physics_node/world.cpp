#include "physics_node/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include "common/error/error.h"
#include "common/math/hash.h"
#include "physics_node/step/stable_step.h"

namespace palpate::physics {
namespace {

constexpr Index masses_worth_a_team = 20000;  // below, waking a second thread costs more than it brings
constexpr std::int64_t frames_between_saves = 50;

int choose_threads(const Scene& scene, Index n_masses) {
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  if (scene.physics.threads > 0) return scene.physics.threads;
  return n_masses >= masses_worth_a_team ? cores : 1;
}

}  // namespace

World::World(const Scene& scene) : scene_(scene) {
  if (scene.physics.integrator != Integrator::symplectic_euler) {
    throw InputError(fmt::format("{}: this version integrates with \"symplectic_euler\" only",
                                 scene.physics.place.text()));
  }
  Index n_masses = 0;
  stable_dt_ = std::numeric_limits<double>::infinity();
  for (const BodySpec& spec : scene.bodies) {
    Body body = build_body(spec, scene.materials);
    stable_dt_ = std::min(stable_dt_, stable_step(body));
    n_masses += body.lattice.n_masses();
    any_yields_ = any_yields_ || body.law.yields;
    const Lattice& lattice = body.lattice;
    const double bucket =
        4 * (lattice.kind == LatticeKind::fcc ? lattice.rest_length[0] : lattice.step.maxCoeff());
    bodies_.push_back(make_moving_body(std::move(body), scene.physics.precision));
    touchable_.push_back({bodies_.back().get(), std::make_unique<ContactSurface>(*bodies_.back(), bucket)});
  }
  for (std::uint32_t n = 0; n < scene.tools.size(); ++n) tools_.emplace_back(scene.tools[n], n, touchable_);
  threads_ = choose_threads(scene, n_masses);

  frame_dt_ = 1.0 / scene.physics.frame_Hz;
  const double wanted = scene.physics.step.value_or(scene.physics.safety * stable_dt_);
  n_substeps_ =
      std::isfinite(wanted) ? std::max(1, static_cast<int>(std::ceil(frame_dt_ / wanted - 1e-9))) : 1;
  dt_ = frame_dt_ / n_substeps_;
  if (dt_ > stable_dt_) {
    remarks_.push_back(
        fmt::format("{}: a step of {:.4g} ms is above the stable {:.4g} ms; expect the guard to act",
                    scene.physics.place.text(), 1e3 * dt_, 1e3 * stable_dt_));
  }
  if (bodies_.size() > 1) remarks_.emplace_back("bodies touch tools and the floor, not yet each other");
  for (auto& body : bodies_) body->save();
}

void World::step(double dt) noexcept {
  for (auto& body : bodies_) {
    const StageTimer timer(report_, Stage::element_forces);
    body->element_forces_and_integrate(dt, scene_.gravity, threads_);
  }
  bool any_force = scene_.floor.has_value();
  for (const auto& tool : tools_) any_force = any_force || !tool.forces().empty();
  if (any_force) {
    const StageTimer timer(report_, Stage::contact_forces);
    for (const auto& tool : tools_) {
      if (tool.forces().empty()) continue;
      auto& body = *bodies_[tool.touched_body()];
      body.kick(tool.forces(), dt);
      for (const auto& nodal : tool.forces())
        report_.tool_work += dt * nodal.force.dot(body.velocity(nodal.cell));
    }
    if (scene_.floor)
      for (auto& body : bodies_) body->bounce_off_floor(scene_.floor->height);
  } else {
    ++report_[Stage::contact_forces].skipped;
  }
  ++report_[Stage::integrate].skipped;  // fused with the forces

  if (any_yields_) {
    const StageTimer timer(report_, Stage::yield_and_break);
    for (auto& body : bodies_)
      if (body->body().law.yields) report_.broken += body->yield_and_break(threads_);
  } else {
    ++report_[Stage::yield_and_break].skipped;
  }
  ++report_.steps;
}

void World::guard() noexcept {
  const StageTimer timer(report_, Stage::guard_finite);
  for (auto& body : bodies_) {
    if (body->is_finite()) {
      if (report_.frames % frames_between_saves == 0) body->save();
      continue;
    }
    ++report_.nonfinite;
    ++report_.restored;
    body->restore();
  }
}

void World::frame(std::span<const std::optional<ToolState>> tools) noexcept {
  if (tools_.empty()) {
    ++report_[Stage::take_tools].skipped;
    ++report_[Stage::find_contacts].skipped;
  } else {
    {
      const StageTimer timer(report_, Stage::take_tools);
      for (std::size_t n = 0; n < tools_.size(); ++n) {
        const bool fresh = n < tools.size() && tools[n].has_value();
        tools_[n].take(fresh ? &*tools[n] : nullptr, frame_dt_);
      }
    }
    const StageTimer timer(report_, Stage::find_contacts);
    for (auto& tool : tools_) tool.find_contact(t_);
  }
  for (int n = 0; n < n_substeps_; ++n) step(dt_);
  guard();
  t_ += frame_dt_;
  ++report_.frames;
}

void World::reset() noexcept {
  for (auto& body : bodies_) body->reset();
}

std::uint64_t World::state_hash() const noexcept {
  std::uint64_t seed = hash_seed;
  for (const auto& body : bodies_) seed = body->hash(seed);
  return seed;
}

}  // namespace palpate::physics
