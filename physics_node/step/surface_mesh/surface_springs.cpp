#include "physics_node/step/surface_mesh/surface_springs.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "physics_node/step/fem/four_array.h"
#include "physics_node/step/surface_mesh/surface_spectrum.h"

namespace palpate::physics {
namespace {

constexpr std::size_t piece = 512;  // of springs, nodes or triangles. Why: some microseconds of work

std::size_t pieces_of(std::size_t n) { return (n + piece - 1) / piece; }

double sum_of(const std::vector<double>& parts) { return std::accumulate(parts.begin(), parts.end(), 0.0); }

}  // namespace

template <class Real>
SurfaceSprings<Real>::SurfaceSprings(const SpringSurface& surface, const std::vector<double>& inverse_mass)
    : membrane_(surface.membrane), rest_volume_(surface.volume), inverse_mass_(inverse_mass) {
  Eigen::AlignedBox3d box;
  for (const Vec3& x : surface.mesh.nodes) box.extend(x);
  rest_.reserve(capacity());
  for (const Vec3& x : surface.mesh.nodes) rest_.push_back(x - box.center());
  drag_.assign(capacity(), membrane_.drag);
  list_springs(surface);
  u_ = ZeroedArray<Real>(4 * capacity(), 0), v_ = ZeroedArray<Real>(4 * capacity(), 1);
  if (capacity() > n_nodes()) prepare_for_cuts(surface);
  const std::size_t most_springs = joints_.springs.capacity();
  now_.resize(most_springs), pulls_.resize(most_springs);
  x_ = rest_;
  x_.resize(capacity(), Vec3::Zero());
  area_.resize(joints_.triangles.size());
  damping_.assign(capacity(), Vec3::Zero()), damping_before_ = damping_;
  elastic_.resize(pieces_of(most_springs));
  volumes_.resize(pieces_of(joints_.triangles.size()));
  ledger_.resize(pieces_of(capacity()));
  omega2_at_rest_ = omega2();
  if (capacity() > n_nodes())
    omega2_at_rest_ = std::max(omega2_at_rest_, stiffest_mode_of_loose_triangles(surface).omega2);
}

/// At each node its springs, in their order, and its triangles.
template <class Real>
void SurfaceSprings<Real>::list_springs(const SpringSurface& surface) {
  const bool may_be_cut = capacity() > n_nodes();
  joints_.triangles = surface.mesh.triangles;
  std::vector<std::size_t> n_springs(capacity(), 0), n_triangles(capacity(), 0);
  // Why: room for the springs of all its triangles alone
  joints_.springs.reserve(may_be_cut ? 3 * joints_.triangles.size() : surface.springs.size());
  for (const SurfaceSpring& spring : surface.springs) {
    const auto [a, b] = spring.node;
    const Vec3 d = rest_[static_cast<std::size_t>(b)] - rest_[static_cast<std::size_t>(a)];
    joints_.springs.push_back({.rest = Four::Zero(),
                               .node = spring.node,
                               .k = static_cast<Real>(spring.k),
                               .length = static_cast<Real>(spring.length)});
    joints_.springs.back().rest.template head<3>() = d.array().cast<Real>();
    for (const Index node : spring.node) ++n_springs[static_cast<std::size_t>(node)];
  }
  for (const MeshTriangle& corners : joints_.triangles)
    for (const Index node : corners) ++n_triangles[static_cast<std::size_t>(node)];
  std::size_t at = 0, around_at = 0;
  for (std::size_t n = 0; n < n_nodes(); ++n) {
    joints_.of_node.push_back({at, at}), joints_.around_node.push_back({around_at, around_at});
    at += may_be_cut ? 2 * n_triangles[n] : n_springs[n];
    around_at += n_triangles[n];
  }
  joints_.of_node.resize(capacity()), joints_.around_node.resize(capacity());
  joints_.incident.resize(at), joints_.around.resize(around_at);
  for (std::size_t s = 0; s < joints_.springs.size(); ++s)
    for (std::size_t end = 0; end < 2; ++end) {
      Range& of = joints_.of_node[static_cast<std::size_t>(joints_.springs[s].node[end])];
      joints_.incident[of.end++] = {end == 0 ? 1.0 : -1.0, static_cast<Index>(s)};
    }
  for (std::size_t t = 0; t < joints_.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const MeshTriangle& of = joints_.triangles[t];
      Range& range = joints_.around_node[static_cast<std::size_t>(of[k])];
      joints_.around[range.end++] = {static_cast<Index>(t), {of[(k + 1) % 3], of[(k + 2) % 3]}};
    }
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
  each(step, joints_.springs.size(), [&](std::size_t p, std::size_t begin, std::size_t end) {
    double elastic = 0;
    for (std::size_t s = begin; s < end; ++s) {
      const Spring& spring = joints_.springs[s];
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
  each(step, joints_.triangles.size(), [&](std::size_t p, std::size_t begin, std::size_t end) {
    double volume = 0;
    for (std::size_t t = begin; t < end; ++t) {
      const auto at = [&](std::size_t k) -> const Vec3& {
        return x_[static_cast<std::size_t>(joints_.triangles[t][k])];
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
  for (std::size_t t = joints_.around_node[node].begin; t < joints_.around_node[node].end; ++t)
    sum += area_[static_cast<std::size_t>(joints_.around[t].triangle)];
  return sum / 3;
}

template <class Real>
typename SurfaceSprings<Real>::Felt SurfaceSprings<Real>::felt(std::size_t node) const noexcept {
  Pull sum;
  for (std::size_t i = joints_.of_node[node].begin; i < joints_.of_node[node].end; ++i) {
    const auto [sign, spring] = joints_.incident[i];
    const Pull& pull = pulls_[static_cast<std::size_t>(spring)];
    sum.elastic += sign * pull.elastic;
    sum.damping += sign * pull.damping;
  }
  Felt felt{sum.elastic.template head<3>().matrix(), sum.damping.template head<3>().matrix()};
  if (is_filled()) felt.elastic += pressure_ * swelling(node);
  felt.damping -= drag_[node] * vector_at(v_, node);
  return felt;
}

template <class Real>
double SurfaceSprings<Real>::stiffness(std::size_t node) const noexcept {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::size_t i = joints_.of_node[node].begin; i < joints_.of_node[node].end; ++i) {
    const auto s = static_cast<std::size_t>(joints_.incident[i].spring);
    const SpringNow& now = now_[s];
    const Vec3 u = now.u.template head<3>().template cast<double>().matrix();
    const double across = now.tension > 0 ? static_cast<double>(now.tension / now.length) : 0.0;
    sum += (static_cast<double>(joints_.springs[s].k) - across) * u * u.transpose() +
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
    for (std::size_t t = joints_.around_node[node].begin; t < joints_.around_node[node].end; ++t)
      sum.of_nodes += std::abs(pressure_) / 3 *
                      (x_[static_cast<std::size_t>(joints_.around[t].others[1])] -
                       x_[static_cast<std::size_t>(joints_.around[t].others[0])])
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
  if (is_filled() && membrane_.pressure != 0) look_at_volume(step);  // where it is now
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
