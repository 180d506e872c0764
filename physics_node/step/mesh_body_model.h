#pragma once
// A body that is a mesh, as the others know it, whatever its elements are. It is stepped by symplectic Euler, never
// sleeps, and nothing of it breaks; tetrahedra and triangles come apart along faces and edges where a tool cuts
// (mesh/simplex_net.h).

#include <algorithm>
#include <array>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "physics_node/body/kept_momentum.h"
#include "physics_node/step/body_model.h"
#include "physics_node/step/good_state.h"
#include "physics_node/step/rebound.h"
#include "physics_node/step/rigid_fit.h"

namespace palpate::physics {

/// Its nodes move as `Elements` say: Tetrahedra or SurfaceSprings.
template <class Elements>
class MeshBodyModel final : public BodyModel {
 public:
  /// @param start  as of make_body_model()
  MeshBodyModel(Body body, std::vector<Vec3> start, Elements elements)
      : BodyModel(body_),
        body_(std::move(body)),
        keeps_momentum_(keeps_momentum(body_)),
        start_(std::move(start)),
        elements_(std::move(elements)),
        saved_(elements_.saved(), elements_.saved()) {
    NodeMotion::show(NodeField(elements_.displacements()), NodeField(elements_.velocities()));
    Topology::show(net() != nullptr ? Adjacency(body_.mesh->neighbours, *net()) : body_.adjacency());
    if (body_.may_be_cut) {
      marked_.emplace().of.resize(capacity());
      if (net() != nullptr) marked_->open.reserve(net()->most_open());
    }
    reset();
  }

  StepOutcome advance(const ExplicitStep& step, std::span<const NodalForce> forces) noexcept override {
    if (net() != nullptr) net()->begin();
    if (unknown_for_ > 0) --unknown_for_;
    const double acts = step.acts_for * step.dt;
    if (keeps_momentum_) momentum_.step(step.gravity, acts, step.dt);
    const StepOutcome outcome = move(step, acts);
    kick(forces, step.dt);
    return outcome;
  }
  PendingStep* pending() noexcept override { return nullptr; }

  void prepare_for(Disturbance from_outside) override {
    if (from_outside == Disturbance::impulses) v_before_.resize(capacity(), Vec3::Zero());
  }
  void remember_velocities() noexcept override {
    if (v_before_.empty()) return;
    body_.each_node([this](Index node) { v_before_[static_cast<std::size_t>(node)] = velocity(node); });
  }

  /// As step/lattice/bounce.h.
  Bounces bounce_off(const Plane& plane, double e, double dt) noexcept override {
    Bounces sum;
    body_.each_node([&](Index node) {
      const double w = inverse_mass(node);
      const Vec3 v_move = velocity(node), x = position(node) - dt * v_move;
      if (w == 0 || plane.n.dot(x) >= plane.height) return;
      const double v_n = plane.n.dot(mean_velocity(node, v_move));
      if (v_n >= 0) return;
      const double dv = rebound(e, v_n, plane.n.dot(v_move));
      push_one(node, dv * plane.n, dt);
      ++sum.masses;
      sum.lost -= (dv * v_n + 0.5 * dv * dv) / w;
    });
    return sum;
  }

  void sleep_and_wake(double) noexcept override {}
  void wake_all() noexcept override {}
  double sleeping_fraction() const noexcept override { return 0; }
  bool sleeps(Index) const noexcept override { return false; }
  bool is_finite() const noexcept override { return elements_.is_finite(); }

  void save(bool good) noexcept override { elements_.save(saved_.next(good)); }
  void restore() noexcept override {
    elements_.bring_back(saved_.good());
    if (net() != nullptr) net()->begin();  // what has parted stays so, and all know of it
    save(false);
  }
  void reset() noexcept override {
    elements_.forget();
    rejoin();
    for (const Index node : body_.nodes()) {
      const auto n = static_cast<std::size_t>(node);
      elements_.place(node, start_.empty() ? Vec3(Vec3::Zero()) : start_[n],
                      inverse_mass(node) > 0 ? body_.velocity : Vec3(Vec3::Zero()));
    }
    momentum_ = {}, touched_ = false;
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
      book_push(dt * nodal.force, nodal.cell, dt);
      elements_.push(nodal.cell, w * dt * nodal.force, dt);
    }
  }
  double power(std::span<const NodalForce> forces) const noexcept override {
    double sum = 0;
    for (const NodalForce& nodal : forces)
      if (inverse_mass(nodal.cell) > 0) sum += nodal.force.dot(velocity(nodal.cell));
    return sum;
  }
  void place(Index node, const Vec3& displacement, const Vec3& velocity) noexcept override {
    if (inverse_mass(node) > 0) elements_.place(node, displacement, velocity);
  }

  TopologyEvents events() const noexcept override {
    if (net() == nullptr) return {};
    return {.edges_gone = {}, .cells_gone = {}, .nodes_split = net()->splits(), .overflow = unknown_for_ > 0};
  }
  std::int64_t breaks() const noexcept override { return net() != nullptr ? net()->n_open() : 0; }
  std::int64_t cut(std::span<const EdgeGone> between) noexcept override {
    if constexpr (!may_part) return 0;
    if (net() == nullptr) return 0;
    const std::size_t known = net()->splits().size();
    std::int64_t opened = 0;
    for (const EdgeGone& gone : between) opened += net()->open(gone.a, gone.b) ? 1 : 0;
    take_copies(net()->splits().subspan(known));
    return opened;
  }
  void mark() noexcept override {
    if (!marked_) return;
    body_.each_node([this](Index node) {
      marked_->of[static_cast<std::size_t>(node)] = {displacement(node), velocity(node)};
    });
    marked_->grown = grown_;
    if (net() != nullptr) marked_->open.assign(net()->open_faces().begin(), net()->open_faces().end());
  }
  void return_to_mark() noexcept override {
    if (!marked_) return;
    elements_.forget();
    rejoin();
    if (net() != nullptr) {
      for (const auto& [a, b] : marked_->open) net()->open(a, b);
      take_copies(net()->splits());
    }
    grown_ = marked_->grown;
    body_.each_node([this](Index node) {
      const auto& [u, v] = marked_->of[static_cast<std::size_t>(node)];
      elements_.place(node, u, v);
    });
    momentum_ = {};
    restart_momentum();
    save(false);
    save(true);
  }
  void conditions(std::span<const Index> nodes, std::span<Condition> out) const noexcept override {
    std::fill_n(out.begin(), nodes.size(), Condition{});
  }

  Watch watch() const noexcept override { return elements_.watch(); }
  Energies energies(const Vec3& gravity) const override { return elements_.energies(gravity); }
  double energy_now() const noexcept override {
    const Energies now = elements_.energies(Vec3::Zero());
    return now.kinetic + now.elastic;
  }
  Losses due() const override { return elements_.due(); }
  Losses losses() const override {
    Losses all = elements_.losses();
    all.broken -= grown_, all.breaks = breaks();
    return all;
  }
  Momenta momenta() const override { return measured().momenta; }
  bool touched() const noexcept override { return touched_; }
  void restart_momentum() noexcept override { momentum_.restart(measured()); }
  MomentumBalance momentum_balance() const override { return momentum_.balance(momenta()); }
  std::uint64_t hash(std::uint64_t seed) const noexcept override { return elements_.hash(seed); }

  BodyCounts counts() const override {
    BodyCounts counts;
    counts.elements = counts.live_elements = body_.n_elements();
    counts.max_stretch = elements_.largest_stretch();
    if constexpr (requires { elements_.least_J(); }) counts.least_corner_J = elements_.least_J();
    counts.shape_rms = rigid_fit_rms([&](const auto& visit) {
      for (const Index node : body_.nodes()) visit(body_.rest_position(node), position(node));
    });
    return counts;
  }

 private:
  StepOutcome move(const ExplicitStep& step, double acts) noexcept {
    if constexpr (requires { elements_.drift(acts); })
      return acts == 0 && !step.watch ? elements_.drift(step.dt) : elements_.step(step, acts);
    else
      return elements_.step(step);
  }

  /// Of a body to come back to.
  struct Mark {
    struct Node {
      Vec3 u = Vec3::Zero(), v = Vec3::Zero();  // displacement [m], velocity [m/s]
    };
    std::vector<Node> of;
    std::vector<std::array<Index, 2>> open;  // elements on both sides of each open face, in their order
    double grown = 0;                        // [J]
  };

  using Net = typename Elements::Net;
  static constexpr bool may_part = requires(Elements & e, const Net& net) { e.separate({}, net); };

  Net* net() const noexcept {
    if constexpr (std::is_same_v<Net, TetNet>)
      return body_.mesh->net.get();
    else
      return body_.mesh->triangles.get();
  }
  std::size_t capacity() const { return static_cast<std::size_t>(body_.capacity()); }
  double inverse_mass(Index node) const noexcept {
    return body_.inverse_mass[static_cast<std::size_t>(node)];
  }
  /// Of the velocities that moved it in the last two steps, where that before was remembered.
  Vec3 mean_velocity(Index node, const Vec3& v_move) const noexcept {
    return v_before_.empty() ? v_move : Vec3(0.5 * (v_move + v_before_[static_cast<std::size_t>(node)]));
  }
  /// Where no summary tells of it, it is left out: two roots and a moment for each strand and step, a
  /// twentieth of a bag's time.
  void book_push(const Vec3& impulse, Index node, double dt) noexcept {
    touched_ = true;
    if (keeps_momentum_) momentum_.push(impulse, position(node) - dt * velocity(node), dt);
  }
  void push_one(Index node, const Vec3& dv, double dt) noexcept {
    book_push(dv / inverse_mass(node), node, dt);
    elements_.push(node, dv, dt);
    // It acts before the elements do: who reads the mean of this and the velocity after them finds all of it.
    if (!v_before_.empty()) v_before_[static_cast<std::size_t>(node)] += dv;
  }

  MomentumAccount::Start measured() const noexcept {
    MomentumAccount::Start sum;
    body_.each_node([&](Index node) {
      sum.add(body_.mesh->mass[static_cast<std::size_t>(node)], position(node), velocity(node));
    });
    return sum;
  }

  void give_mass(Index node) noexcept {
    if constexpr (may_part) {
      const auto n = static_cast<std::size_t>(node);
      const double mass = elements_.mass(node, *net());
      body_.mesh->mass[n] = mass;
      const bool held = body_.inverse_mass[static_cast<std::size_t>(net()->origin(node))] == 0;
      body_.inverse_mass[n] = held ? 0 : 1 / mass;
    }
  }
  void take_copies(std::span<const NodeSplit> splits) noexcept {
    if constexpr (may_part) {
      grown_ += elements_.separate(splits, *net());
      for (const NodeSplit& split : splits) {
        for (const Index node : {split.node, split.copy}) give_mass(node);
        saved_.each([&](auto& saved) { elements_.copy_saved(saved, split.node, split.copy); });
        if (!v_before_.empty())
          v_before_[static_cast<std::size_t>(split.copy)] = v_before_[static_cast<std::size_t>(split.node)];
      }
    }
  }
  /// As loaded.
  void rejoin() noexcept {
    if constexpr (may_part) {
      if (net() == nullptr) return;
      net()->reset();
      elements_.rejoin();
      for (const Index node : body_.nodes()) give_mass(node);
      grown_ = 0;
      unknown_for_ = 2;
    }
  }

  Body body_;
  const bool keeps_momentum_;
  bool touched_ = false;
  std::vector<Vec3> start_;  // displacements of its nodes; EMPTY: none [m]
  mutable Elements
      elements_;  // what measures it writes forces and energies of its elements, which the next step makes anew
  std::vector<Vec3> v_before_;  // that moved its nodes in the step before the last; EMPTY: not for contact
  MomentumAccount momentum_;
  double grown_ = 0;     // elastic energy that parting has made [J]
  int unknown_for_ = 0;  // steps: after a reset, at once and after the next, events tell nothing
  GoodState<typename Elements::Saved> saved_;
  std::optional<Mark> marked_;  // only of a body that may be cut
};

}  // namespace palpate::physics
