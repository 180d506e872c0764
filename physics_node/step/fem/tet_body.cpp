#include "physics_node/step/fem/tet_body.h"
#include "physics_node/step/good_state.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "physics_node/step/fem/tetrahedra.h"
#include "physics_node/step/rebound.h"
#include "physics_node/step/rigid_fit.h"

namespace palpate::physics {
namespace {

template <class Real>
class TetBody final : public BodyModel {
 public:
  TetBody(Body body, std::vector<Vec3> start)
      : BodyModel(body_),
        body_(std::move(body)),
        start_(std::move(start)),
        tets_(body_.mesh->model),
        saved_(tets_.saved(), tets_.saved()) {
    NodeMotion::show(NodeField(tets_.displacements()), NodeField(tets_.velocities()));
    Topology::show(body_.adjacency());
    reset();
  }

  StepOutcome advance(const ExplicitStep& step, std::span<const NodalForce> forces) noexcept override {
    momentum_.step(step.gravity, step.dt, step.dt);
    const StepOutcome outcome = tets_.step(step);
    kick(forces, step.dt);
    return outcome;
  }
  PendingStep* pending() noexcept override { return nullptr; }

  void prepare_for(Disturbance from_outside) override {
    if (from_outside == Disturbance::impulses) v_before_.resize(n_nodes(), Vec3::Zero());
  }
  void remember_velocities() noexcept override {
    for (std::size_t n = 0; n < v_before_.size(); ++n) v_before_[n] = velocity(static_cast<Index>(n));
  }

  /// As step/lattice/bounce.h.
  Bounces bounce_off(const Plane& plane, double e, double dt) noexcept override {
    Bounces sum;
    for (const Index node : body_.nodes()) {
      const double w = inverse_mass(node);
      const Vec3 v_move = velocity(node), x = position(node) - dt * v_move;
      if (w == 0 || plane.n.dot(x) >= plane.height) continue;
      const double v_n = plane.n.dot(mean_velocity(node, v_move));
      if (v_n >= 0) continue;
      const double dv = rebound(e, v_n, plane.n.dot(v_move));
      push_one(node, dv * plane.n, dt);
      ++sum.masses;
      sum.lost -= (dv * v_n + 0.5 * dv * dv) / w;
    }
    return sum;
  }

  void sleep_and_wake(double) noexcept override {}
  void wake_all() noexcept override {}
  double sleeping_fraction() const noexcept override { return 0; }
  bool is_finite() const noexcept override { return tets_.is_finite(); }

  void save(bool good) noexcept override { tets_.save(saved_.next(good)); }
  void restore() noexcept override {
    tets_.bring_back(saved_.good());
    save(false);
  }
  void reset() noexcept override {
    tets_.forget();
    for (const Index node : body_.nodes()) {
      const auto n = static_cast<std::size_t>(node);
      tets_.place(node, start_.empty() ? Vec3(Vec3::Zero()) : start_[n],
                  inverse_mass(node) > 0 ? body_.velocity : Vec3(Vec3::Zero()));
    }
    momentum_ = {};
    restart_momentum();
    save(false);
    save(true);
  }

  void read(std::span<const std::uint32_t> which, std::span<const Index> cells, std::span<const Vec3> rest,
            double dt, std::span<Vec3> x, std::span<Vec3> v, std::span<Vec3> v_move) const noexcept override {
    for (const std::uint32_t n : which) {
      v_move[n] = velocity(cells[n]);
      v[n] = mean_velocity(cells[n], v_move[n]);
      x[n] = rest[n] + displacement(cells[n]) - dt * v_move[n];
    }
  }
  void push(std::span<const NodalPush> pushes, double dt) noexcept override {
    for (const NodalPush& one : pushes)
      if (inverse_mass(one.cell) > 0) push_one(one.cell, one.dv, dt);
  }
  void kick(std::span<const NodalForce> forces, double dt) noexcept override {
    for (const NodalForce& nodal : forces) {
      const double w = inverse_mass(nodal.cell);
      if (w == 0) continue;
      momentum_.push(dt * nodal.force, position(nodal.cell) - dt * velocity(nodal.cell), dt);
      tets_.push(nodal.cell, w * dt * nodal.force, dt);
    }
  }
  double power(std::span<const NodalForce> forces) const noexcept override {
    double sum = 0;
    for (const NodalForce& nodal : forces)
      if (inverse_mass(nodal.cell) > 0) sum += nodal.force.dot(velocity(nodal.cell));
    return sum;
  }
  void place(Index node, const Vec3& displacement, const Vec3& velocity) noexcept override {
    if (inverse_mass(node) > 0) tets_.place(node, displacement, velocity);
  }

  TopologyEvents events() const noexcept override { return {}; }
  std::int64_t breaks() const noexcept override { return 0; }
  std::int64_t cut(std::span<const EdgeGone>) noexcept override { return 0; }
  void conditions(std::span<const Index> nodes, std::span<Condition> out) const noexcept override {
    std::fill_n(out.begin(), nodes.size(), Condition{});
  }

  Watch watch() const noexcept override { return tets_.watch(); }
  Energies energies(const Vec3& gravity) const override { return tets_.energies(gravity); }
  double energy_now() const noexcept override {
    const Energies now = tets_.energies(Vec3::Zero());
    return now.kinetic + now.elastic;
  }
  Losses due() const override { return tets_.due(); }
  Losses losses() const override { return tets_.losses(); }
  Momenta momenta() const override { return measured().momenta; }
  bool touched() const noexcept override { return momentum_.hits() > 0; }
  void restart_momentum() noexcept override { momentum_.restart(measured()); }
  MomentumBalance momentum_balance() const override { return momentum_.balance(momenta()); }
  std::uint64_t hash(std::uint64_t seed) const noexcept override { return tets_.hash(seed); }

  BodyCounts counts() const override {
    BodyCounts counts;
    counts.elements = counts.live_elements = body_.n_elements();
    counts.max_stretch = largest_stretch();
    counts.least_corner_J = tets_.least_J();
    Eigen::Matrix3Xd rest(3, body_.n_nodes()), now(3, body_.n_nodes());
    for (const Index node : body_.nodes())
      rest.col(node) = body_.rest_position(node), now.col(node) = position(node);
    counts.shape_rms = rigid_fit_rms(rest, now);
    return counts;
  }

 private:
  std::size_t n_nodes() const { return body_.mesh->nodes.size(); }
  double inverse_mass(Index node) const noexcept {
    return body_.inverse_mass[static_cast<std::size_t>(node)];
  }
  /// Of the velocities that moved it in the last two steps, where that before was remembered.
  Vec3 mean_velocity(Index node, const Vec3& v_move) const noexcept {
    return v_before_.empty() ? v_move : Vec3(0.5 * (v_move + v_before_[static_cast<std::size_t>(node)]));
  }
  void push_one(Index node, const Vec3& dv, double dt) noexcept {
    momentum_.push(dv / inverse_mass(node), position(node) - dt * velocity(node), dt);
    tets_.push(node, dv, dt);
    // It acts before the elements do: who reads the mean of this and the velocity after them finds all of it.
    if (!v_before_.empty()) v_before_[static_cast<std::size_t>(node)] += dv;
  }

  MomentumAccount::Start measured() const noexcept {
    MomentumAccount::Start sum;
    for (const Index node : body_.nodes())
      sum.add(body_.mesh->mass[static_cast<std::size_t>(node)], position(node), velocity(node));
    return sum;
  }

  /// Of the tetrahedra that the mesh fills: of second order the eight parts of each.
  double largest_stretch() const {
    double largest2 = 1;
    const MeshBody& mesh = *body_.mesh;
    for (const auto& corners : mesh.filled) {
      Eigen::Matrix3d gradient = Eigen::Matrix3d::Identity();
      const auto slopes = slopes_of(mesh.model.mesh, corners);
      for (std::size_t k = 0; k < 3; ++k)
        gradient += (displacement(corners[k + 1]) - displacement(corners[0])) * slopes[k].transpose();
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> squared(gradient.transpose() * gradient,
                                                                   Eigen::EigenvaluesOnly);
      largest2 = std::max(largest2, squared.eigenvalues()[2]);
    }
    return std::sqrt(largest2);
  }

  Body body_;
  std::vector<Vec3> start_;  // displacements of its nodes; EMPTY: none [m]
  mutable Tetrahedra<Real>
      tets_;  // what measures it writes forces and energies of its elements, which the next step makes anew
  std::vector<Vec3> v_before_;  // that moved its nodes in the step before the last; EMPTY: not for contact
  MomentumAccount momentum_;
  GoodState<typename Tetrahedra<Real>::Saved> saved_;
};

}  // namespace

std::unique_ptr<BodyModel> make_tet_body(Body body, Precision precision, std::vector<Vec3> start) {
  if (precision == Precision::single_)
    return std::make_unique<TetBody<float>>(std::move(body), std::move(start));
  return std::make_unique<TetBody<double>>(std::move(body), std::move(start));
}

}  // namespace palpate::physics
