#include "bench/peers/measure.h"
#include "bench/problems/median.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

namespace palpate::bench {
namespace {

std::vector<Solver*> all_solvers(const std::vector<Peer>& peers) {
  std::vector<Solver*> solvers;
  for (const Peer& peer : peers)
    for (const auto& solver : peer.solvers) solvers.push_back(solver.get());
  return solvers;
}

/// One solver with one task, measured again and again.
struct Series {
  Solver* solver = nullptr;
  Task task;
  std::optional<double> error;  // nothing: not sound
  std::vector<double> cpu_s, wall_s;

  void add(const Run& run) { cpu_s.push_back(run.cpu_s), wall_s.push_back(run.wall_s); }
  Point point() const {
    const SpringBody& body = task.drop->body;
    return {solver->method(), body.rest.size(), body.springs.size(), task.dt(),
            task.steps(),     median(cpu_s),    median(wall_s),      error.value_or(0)};
  }
};

std::vector<Vec3> must_run(Solver& solver, const Task& task) {
  Run run = solver.run(task);
  if (!run.sound) throw std::runtime_error(solver.method().label() + ": did not stay stable where it must");
  return std::move(run.displacement);
}

}  // namespace

std::string Method::label() const {
  return fmt::format("{} {}, {}, {} thread{}", peer, name, precision == "single" ? "float" : precision,
                     threads, threads == 1 ? "" : "s");
}

double relative_difference(const std::vector<Vec3>& x, const std::vector<Vec3>& reference) {
  if (x.size() != reference.size()) return std::numeric_limits<double>::infinity();
  double difference = 0, whole = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    difference += (x[i] - reference[i]).squaredNorm();
    whole += reference[i].squaredNorm();
  }
  const double ratio = std::sqrt(difference / whole);
  return std::isfinite(ratio) ? ratio : std::numeric_limits<double>::infinity();
}

DropResult measure_drop(const Plan& plan, const std::vector<Peer>& peers, const Say& say) {
  const Drop drop = make_drop(plan.drop_masses);
  const auto exact = palpate_reference(Scheme::leapfrog);
  const int coarsest = static_cast<int>(std::ceil(frame_seconds / drop.stable_step));
  const Task finest{&drop, plan.drop_frames, 64 * coarsest, true};
  const Task half{&drop, plan.drop_frames, 32 * coarsest, true};
  say("reference of the drop");
  const std::vector<Vec3> reference = must_run(*exact, finest);
  DropResult result;
  result.stable_step = drop.stable_step;
  result.reference_dt = finest.dt();
  result.reference_error = relative_difference(must_run(*exact, half), reference) / 3;

  std::vector<Series> all;
  for (Solver* solver : all_solvers(peers))
    for (const int steps : solver->method().drop_steps)
      all.push_back({solver, {&drop, plan.drop_frames, steps, true}, {}, {}, {}});
  for (int round = 0; round < plan.repeats; ++round) {
    for (Series& series : all) {
      if (round > 0 && !series.error) continue;
      say(fmt::format("drop, round {} of {}: {}, step {:.4g} ms", round + 1, plan.repeats,
                      series.solver->method().label(), 1e3 * series.task.dt()));
      series.task.positions = round == 0;
      const Run run = series.solver->run(series.task);
      if (round == 0) {
        const double error = relative_difference(run.displacement, reference);
        if (run.sound && error < 1) series.error = error;
      }
      series.add(run);
    }
  }
  for (const Series& series : all) {
    if (series.error)
      result.points.push_back(series.point());
    else
      result.unstable.push_back(
          fmt::format("{} at {:.4g} ms", series.solver->method().label(), 1e3 * series.task.dt()));
  }
  return result;
}

std::vector<Point> measure_steps(const Plan& plan, const std::vector<Peer>& peers, const Say& say) {
  std::vector<Point> points;
  for (const int masses : plan.sizes) {
    const Drop drop = make_drop(masses);
    const int steps_per_frame = static_cast<int>(std::ceil(frame_seconds / drop.stable_step));
    std::vector<Series> all;
    for (Solver* solver : all_solvers(peers)) {
      const Method& method = solver->method();
      if (masses > method.largest_body) continue;
      const double frame_s = 1e-9 * method.expected_ns * masses * steps_per_frame;
      const int frames = std::max(5, static_cast<int>(plan.seconds / frame_s));
      all.push_back({solver, {&drop, frames, steps_per_frame, false}, {}, {}, {}});
    }
    for (int round = 0; round < plan.repeats; ++round)
      for (Series& series : all) {
        say(fmt::format("{} masses, round {} of {}: {}", drop.body.rest.size(), round + 1, plan.repeats,
                        series.solver->method().label()));
        const Run run = series.solver->run(series.task);
        if (!run.sound)
          throw std::runtime_error(series.solver->method().label() + ": failed while it was timed");
        series.add(run);
      }
    for (const Series& series : all) points.push_back(series.point());
  }
  return points;
}

std::vector<Agreement> measure_agreement(const std::vector<Peer>& peers) {
  const Drop drop = make_drop(1000);
  const Task task{&drop, 50, static_cast<int>(std::ceil(frame_seconds / drop.stable_step)), true};
  std::map<Scheme, std::vector<Vec3>> ours;
  for (const Scheme scheme : {Scheme::symplectic_euler, Scheme::leapfrog})
    ours[scheme] = must_run(*palpate_reference(scheme), task);
  std::vector<Agreement> all;
  for (Solver* solver : all_solvers(peers))
    all.push_back({solver->method(),
                   relative_difference(solver->run(task).displacement, ours[solver->method().scheme])});
  return all;
}

}  // namespace palpate::bench
