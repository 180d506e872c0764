#include "physics_node/step/surface_mesh/surface_springs.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "physics_node/step/fem/four_array.h"

namespace palpate::physics {
namespace {

constexpr std::size_t piece = 512;  // of springs, nodes or triangles. Why: some microseconds of work

std::size_t pieces_of(std::size_t n) { return (n + piece - 1) / piece; }

double sum_of(const std::vector<double>& parts) { return std::accumulate(parts.begin(), parts.end(), 0.0); }

}  // namespace

template <class Real>
SurfaceSprings<Real>::SurfaceSprings(const SpringSurface& surface, const std::vector<double>& inverse_mass)
    : membrane_(surface.membrane),
      rest_volume_(surface.volume),
      triangles_(surface.mesh.triangles),
      inverse_mass_(inverse_mass) {
  const std::size_t n = n_nodes();
  Eigen::AlignedBox3d box;
  for (const Vec3& x : surface.mesh.nodes) box.extend(x);
  for (const Vec3& x : surface.mesh.nodes) rest_.push_back(x - box.center());
  begin_.assign(n + 1, 0), around_begin_.assign(n + 1, 0);
  for (const SurfaceSpring& spring : surface.springs) {
    const auto [a, b] = spring.node;
    const Vec3 d = rest_[static_cast<std::size_t>(b)] - rest_[static_cast<std::size_t>(a)];
    springs_.push_back({.rest = Four::Zero(),
                        .node = spring.node,
                        .k = static_cast<Real>(spring.k),
                        .length = static_cast<Real>(spring.length)});
    springs_.back().rest.template head<3>() = d.array().cast<Real>();
    for (const Index node : spring.node) ++begin_[static_cast<std::size_t>(node) + 1];
  }
  for (const MeshTriangle& corners : triangles_)
    for (const Index node : corners) ++around_begin_[static_cast<std::size_t>(node) + 1];
  for (auto* begin : {&begin_, &around_begin_})
    std::partial_sum(begin->begin(), begin->end(), begin->begin());
  incident_.resize(begin_.back()), around_.resize(around_begin_.back());
  std::vector<std::size_t> next = begin_, next_around = around_begin_;
  for (std::size_t s = 0; s < springs_.size(); ++s)
    for (std::size_t end = 0; end < 2; ++end)
      incident_[next[static_cast<std::size_t>(springs_[s].node[end])]++] = {end == 0 ? 1.0 : -1.0,
                                                                            static_cast<Index>(s)};
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      around_[next_around[static_cast<std::size_t>(triangles_[t][k])]++] = {
          static_cast<Index>(t), {triangles_[t][(k + 1) % 3], triangles_[t][(k + 2) % 3]}};
  u_ = ZeroedArray<Real>(4 * n, 0), v_ = ZeroedArray<Real>(4 * n, 1);
  now_.resize(springs_.size()), pulls_.resize(springs_.size());
  x_ = rest_;
  area_.resize(triangles_.size());
  damping_.assign(n, Vec3::Zero()), damping_before_ = damping_;
  elastic_.resize(pieces_of(springs_.size()));
  volumes_.resize(pieces_of(triangles_.size()));
  ledger_.resize(pieces_of(n));
  omega2_at_rest_ = omega2();
}

template <class Real>
template <class Work>
void SurfaceSprings<Real>::each(const ExplicitStep& step, std::size_t n, const Work& work) noexcept {
  const std::size_t pieces = pieces_of(n);
  const auto one = [&](std::size_t p) { work(p, p * piece, std::min(n, (p + 1) * piece)); };
  if (step.team == nullptr || step.threads < 2)
    for (std::size_t p = 0; p < pieces; ++p) one(p);
  else
    step.team->each(pieces, step.threads, one);
}

template <class Real>
void SurfaceSprings<Real>::look_at_springs(const ExplicitStep& step) noexcept {
  const auto beta = static_cast<Real>(membrane_.beta);
  each(step, springs_.size(), [&](std::size_t p, std::size_t begin, std::size_t end) {
    double elastic = 0;
    for (std::size_t s = begin; s < end; ++s) {
      const Spring& spring = springs_[s];
      SpringNow& now = now_[s];
      const auto at = [&](const ZeroedArray<Real>& four, std::size_t which) {
        return Eigen::Map<const Four>(four.data() + 4 * static_cast<std::size_t>(spring.node[which]));
      };
      const Four d = spring.rest + (at(u_, 1) - at(u_, 0)), squared = d * d;
      now.length = std::sqrt(squared[0] + squared[1] + squared[2]);
      // Ends at one place push each other nowhere.
      now.u = d * (now.length > 0 ? 1 / now.length : Real(0));
      const Four rates = now.u * (at(v_, 1) - at(v_, 0));
      const Real longer = now.length - spring.length, rate = rates[0] + rates[1] + rates[2];
      now.tension = spring.k * longer;
      pulls_[s].elastic = (now.tension * now.u).template cast<double>();
      pulls_[s].damping = (beta * spring.k * rate * now.u).template cast<double>();
      elastic +=
          0.5 * static_cast<double>(spring.k) * static_cast<double>(longer) * static_cast<double>(longer);
    }
    elastic_[p] = elastic;
  });
}

template <class Real>
void SurfaceSprings<Real>::look_at_volume(const ExplicitStep& step) noexcept {
  each(step, n_nodes(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) x_[n] = rest_[n] + vector_at(u_, n);
  });
  each(step, triangles_.size(), [&](std::size_t p, std::size_t begin, std::size_t end) {
    double volume = 0;
    for (std::size_t t = begin; t < end; ++t) {
      const auto at = [&](std::size_t k) -> const Vec3& {
        return x_[static_cast<std::size_t>(triangles_[t][k])];
      };
      area_[t] = 0.5 * (at(1) - at(0)).cross(at(2) - at(0));
      volume += at(0).dot(area_[t]);
    }
    volumes_[p] = volume / 3;
  });
  volume_ = sum_of(volumes_);
  pressure_ = membrane_.pressure + membrane_.content_modulus * (rest_volume_ - volume_) / rest_volume_;
}

/// V is the sum of x_a . (x_b x x_c) / 6; round a node of a closed surface the sum of x_b x x_c is that of twice the areas.
template <class Real>
Vec3 SurfaceSprings<Real>::swelling(std::size_t node) const noexcept {
  Vec3 sum = Vec3::Zero();
  for (std::size_t t = around_begin_[node]; t < around_begin_[node + 1]; ++t)
    sum += area_[static_cast<std::size_t>(around_[t].triangle)];
  return sum / 3;
}

template <class Real>
typename SurfaceSprings<Real>::Felt SurfaceSprings<Real>::felt(std::size_t node) const noexcept {
  Pull sum;
  for (std::size_t i = begin_[node]; i < begin_[node + 1]; ++i) {
    const auto [sign, spring] = incident_[i];
    const Pull& pull = pulls_[static_cast<std::size_t>(spring)];
    sum.elastic += sign * pull.elastic;
    sum.damping += sign * pull.damping;
  }
  Felt felt{sum.elastic.template head<3>().matrix(), sum.damping.template head<3>().matrix()};
  if (is_filled()) felt.elastic += pressure_ * swelling(node);
  felt.damping -= membrane_.drag * vector_at(v_, node);
  return felt;
}

template <class Real>
double SurfaceSprings<Real>::stiffness(std::size_t node) const noexcept {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = begin_[node]; i < begin_[node + 1]; ++i) {
    const auto s = static_cast<std::size_t>(incident_[i].spring);
    const SpringNow& now = now_[s];
    const Vec3 u = now.u.template head<3>().template cast<double>().matrix();
    const double across = now.tension > 0 ? static_cast<double>(now.tension / now.length) : 0.0;
    sum += (static_cast<double>(springs_[s].k) - across) * u * u.transpose() +
           across * Eigen::Matrix3d::Identity();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(sum, Eigen::EigenvaluesOnly);
  return solver.eigenvalues()[2];
}

template <class Real>
void SurfaceSprings<Real>::Fastest::add(const Fastest& more) noexcept {
  of_nodes = std::max(of_nodes, more.of_nodes);
  of_content += more.of_content;
}

template <class Real>
typename SurfaceSprings<Real>::Fastest SurfaceSprings<Real>::fastest(std::size_t node) const noexcept {
  Fastest sum{2 * stiffness(node), 0};
  if (is_filled()) {
    for (std::size_t t = around_begin_[node]; t < around_begin_[node + 1]; ++t)
      sum.of_nodes += std::abs(pressure_) / 3 *
                      (x_[static_cast<std::size_t>(around_[t].others[1])] -
                       x_[static_cast<std::size_t>(around_[t].others[0])])
                          .norm();
    sum.of_content = membrane_.content_modulus / rest_volume_ * swelling(node).squaredNorm();
  }
  return {sum.of_nodes * inverse_mass_[node], sum.of_content * inverse_mass_[node]};
}

/// v := v + dt (f / m + g). A held node stays. Places stay, too: neighbours still read them.
template <class Real>
void SurfaceSprings<Real>::kick(const ExplicitStep& step, std::size_t begin, std::size_t end,
                                Ledger& ledger) noexcept {
  ledger = {};
  for (std::size_t n = begin; n < end; ++n) {
    const Felt felt = this->felt(n);
    damping_[n] = felt.damping;
    const double w = inverse_mass_[n];
    if (w == 0) continue;
    const Vec3 v = vector_at(v_, n);
    ledger.of_damper -= (damping_[n] + damping_before_[n]).dot(v);
    const Vec3 a = w * (felt.elastic + felt.damping) + step.gravity;
    set_vector(v_, n, v + step.dt * a);
    // See watch_begin in lattice/move_masses.inl: K = m v(-) . v(+) / 2, and v(+) becomes another.
    if (step.dt != dt_before_) ledger.numerical += 0.5 / w * v.dot(a) * (dt_before_ - step.dt);
    if (!step.watch) continue;
    ledger.fastest.add(fastest(n));
    const Vec3 v_after = vector_at(v_, n), u = vector_at(u_, n);
    ledger.speed2 = std::max(ledger.speed2, v_after.squaredNorm());
    ledger.kinetic += 0.5 / w * v_after.squaredNorm();
    ledger.between += 0.5 / w * v.dot(v_after);
    ledger.fallen += (u + step.dt * v_after).dot(step.gravity) / w;
    ledger.fallen_before += u.dot(step.gravity) / w;
  }
}

template <class Real>
void SurfaceSprings<Real>::book(const ExplicitStep& step) noexcept {
  double of_damper = 0;
  for (const Ledger& part : ledger_) of_damper += part.of_damper, numerical_ += part.numerical;
  (of_damper > 0 ? passed_ : numerical_) += 0.5 * dt_before_ * of_damper;
  std::swap(damping_, damping_before_);
  dt_before_ = step.dt;
  if (!step.watch) return;
  viscous_ = passed_;
  watch_ = {};
  watch_.elastic = elastic();
  watch_.fallen_before = given_by_pressure();
  if (membrane_.pressure != 0) look_at_volume(step);  // where it is now
  watch_.fallen = given_by_pressure();
  double speed2 = 0;
  Fastest fastest;
  for (const Ledger& part : ledger_) {
    fastest.add(part.fastest);
    watch_.kinetic += part.kinetic;
    watch_.between += part.between;
    watch_.fallen += part.fallen;
    watch_.fallen_before += part.fallen_before;
    speed2 = std::max(speed2, part.speed2);
  }
  watch_.speed = std::sqrt(speed2);
  stiffening_ = omega2_at_rest_ > 0 ? std::max(1.0, fastest.omega2() / omega2_at_rest_) : 1;
}

template <class Real>
StepOutcome SurfaceSprings<Real>::step(const ExplicitStep& step) noexcept {
  look(step);
  each(step, n_nodes(),
       [&](std::size_t p, std::size_t begin, std::size_t end) { kick(step, begin, end, ledger_[p]); });
  const auto dt = static_cast<Real>(step.dt);
  each(step, n_nodes(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = 4 * begin; i < 4 * end; ++i)
      if (inverse_mass_[i / 4] > 0) u_[i] += dt * v_[i];
  });
  book(step);
  return {.stiffening = stiffening_};
}

template <class Real>
void SurfaceSprings<Real>::look(const ExplicitStep& step) noexcept {
  look_at_springs(step);
  if (is_filled()) look_at_volume(step);
}

template class SurfaceSprings<float>;
template class SurfaceSprings<double>;

}  // namespace palpate::physics
