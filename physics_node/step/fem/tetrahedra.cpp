#include "physics_node/step/fem/tetrahedra.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "physics_node/material/lame.h"
#include "physics_node/step/fem/four_array.h"
#include "physics_node/step/fem/tet_spectrum.h"

namespace palpate::physics {
namespace {

template <class Real, std::size_t n>
void fill_batches(const TetModel& model, const TetLayout& layout, ZeroedArray<TetBatch<Real, n>>& batches) {
  batches = ZeroedArray<TetBatch<Real, n>>(layout.n_batches());
  for (std::size_t at = 0; at < layout.tet.size(); ++at) {
    TetBatch<Real, n>& batch = batches[at / tet_lanes];
    const std::size_t lane = at % tet_lanes;
    for (std::size_t a = 0; a < n; ++a)
      batch.corner[lane][a] = static_cast<std::uint16_t>(corner_step<Real> * layout.corner[n * at + a]);
    if (layout.tet[at] < 0) continue;
    const auto& corners = model.mesh.tets[static_cast<std::size_t>(layout.tet[at])];
    batch.volume[lane] = static_cast<Real>(signed_volume(model.mesh, corners));
    const auto slopes = slopes_of(model.mesh, corners);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t j = 0; j < 3; ++j)
        batch.slope[k][j][lane] = static_cast<Real>(slopes[k][static_cast<Eigen::Index>(j)]);
  }
}

/// V_n of each share [m^3].
void volumes_of_shares(const TetModel& model, const TetLayout& layout, std::vector<double>& volumes) {
  volumes.assign(layout.node_of_share.size(), 0.0);
  for (const TetBlock& block : layout.blocks)
    for (std::size_t at = block.first_batch * tet_lanes;
         at < (block.first_batch + block.n_batches) * tet_lanes; ++at) {
      if (layout.tet[at] < 0) continue;
      const double volume =
          signed_volume(model.mesh, model.mesh.tets[static_cast<std::size_t>(layout.tet[at])]);
      for (std::size_t a = 0; a < 4; ++a) {
        const Index share = layout.share[block.first_part + layout.corner[4 * at + a]];
        volumes[static_cast<std::size_t>(share)] += volume / 4;
      }
    }
}

TetKind kind_of(const TetModel& model) {
  if (!model.mesh.middles.empty()) return TetKind::second_order;
  return has_nodal_pressure(model) ? TetKind::nodal : TetKind::plain;
}

std::size_t chunks(std::size_t n) { return (n + tet_chunk - 1) / static_cast<std::size_t>(tet_chunk); }

}  // namespace

template <class Real>
Tetrahedra<Real>::Tetrahedra(TetModel model, InstructionSet set, std::size_t most_copies)
    : model_(std::move(model)),
      layout_(lay_out(model_, most_copies)),
      kernel_(tet_kernel_of<Real>(set, kind_of(model_))) {
  if (model_.mesh.middles.empty())
    fill_batches(model_, layout_, batches_);
  else
    fill_batches(model_, layout_, batches10_);
  for (const TetMaterial& material : model_.materials) {
    const Lame lame = lame_of(material.modulus, material.poisson_ratio);
    constants_.push_back({.mu = static_cast<Real>(lame.mu), .lambda = static_cast<Real>(lame.lambda)});
    stiffness_at_rest_.push_back(StableNeoHookean<Scalar<double>>{lame.mu, lame.lambda}.stiffness({}));
  }
  std::size_t colour = 0;
  const std::size_t n = n_nodes() + most_copies, parts = layout_.node.size();
  const std::size_t shares = kernel_.elastic.swell != nullptr ? layout_.most_shares : 0;
  const bool damped = model_.beta > 0;
  inverse_mass_ = ZeroedArray<Real>(n, colour++);
  const auto masses = masses_of(model_);
  for (std::size_t i = 0; i < masses.size(); ++i)
    if (model_.held.empty() || !model_.held[i]) inverse_mass_[i] = static_cast<Real>(1 / masses[i]);
  for (auto* of_nodes : {&u_, &v_}) *of_nodes = Four(4 * n, colour++);
  force_ = Four(4 * parts, colour++);
  swelling_ = ZeroedArray<Real>(shares > 0 ? (damped ? 2 : 1) * parts : 0, colour++);
  mean_ = ZeroedArray<Real>(shares, colour++);
  share_volume_ = ZeroedArray<Real>(shares, colour++);
  share_energy_.resize(shares);
  volumes_.reserve(shares);
  if (shares > 0) find_share_volumes();
  for (auto* of_blocks : {&elastic_, &stiffest_, &least_J_}) of_blocks->resize(layout_.blocks.size());
  elastic_of_shares_.resize(chunks(shares));
  ledger_.resize(chunks(n));
  if (most_copies > 0) {
    model_.mesh.nodes.reserve(n);
    if (!model_.held.empty()) model_.held.reserve(n);
    loaded_ = layout_;
    lanes_.emplace(layout_);
    swollen_.reserve(TetNet::most_around);
  }
  if (!damped) return;
  rate_force_ = Four(4 * parts, colour++);
  for (auto* of_nodes : {&seen_rate_, &began_, &mean_v_}) *of_nodes = Four(4 * n, colour++);
  mean_rate_ = ZeroedArray<Real>(shares, colour++);
  mean_rate_before_ = ZeroedArray<Real>(shares, colour++);
  for (auto* powers : {&power_, &power_before_}) powers->resize(layout_.n_batches() + chunks(shares));
  lost_.resize(layout_.blocks.size() + chunks(shares));
  const double omega2 = model_.fastest_omega2 > 0 ? model_.fastest_omega2 : fastest_element(model_);
  z_ = 0.5 * model_.beta * std::sqrt(omega2);
}

template <class Real>
void Tetrahedra<Real>::find_share_volumes() noexcept {
  volumes_of_shares(model_, layout_, volumes_);
  for (std::size_t s = 0; s < volumes_.size(); ++s) {
    const TetMaterial& material = model_.materials[layout_.material_of_share[s]];
    share_volume_[s] = volumes_[s] > 0 ? static_cast<Real>(1 / volumes_[s]) : Real(0);
    share_energy_[s] = 0.5 * lame_of(material.modulus, material.poisson_ratio).lambda * volumes_[s];
  }
}

template <class Real>
TetContext<Real> Tetrahedra<Real>::context() noexcept {
  TetContext<Real> m = {};
  m.batches = batches_.data();
  m.batches10 = batches10_.data();
  m.blocks = layout_.blocks.data();
  m.constants = constants_.data();
  m.node = layout_.node.data();
  m.share = layout_.share.data();
  m.node_begin = layout_.of_node.begin.data();
  m.node_part = layout_.of_node.part.data();
  m.share_begin = layout_.of_share.begin.data();
  m.share_part = layout_.of_share.part.data();
  m.share_volume = share_volume_.data();
  m.share_energy = share_energy_.data();
  m.stiffness_at_rest = stiffness_at_rest_.data();
  m.u = u_.data(), m.v = v_.data();
  m.seen_rate = seen_rate_.data();
  m.inverse_mass = inverse_mass_.data();
  m.force = force_.data();
  m.rate_force = rate_force_.data();
  m.swelling = swelling_.data();
  m.mean = mean_.data();
  m.mean_rate = mean_rate_.data();
  m.mean_rate_before = mean_rate_before_.data();
  if (model_.beta > 0) {
    m.power = power_.data();
    m.power_before = power_before_.data();
    m.power_of_shares = power_.data() + layout_.n_batches();
    m.lost = lost_.data();
    m.lost_of_shares = lost_.data() + layout_.blocks.size();
  }
  m.elastic = elastic_.data();
  m.stiffest = stiffest_.data();
  m.least_J = least_J_.data();
  m.elastic_of_shares = elastic_of_shares_.data();
  m.ledger = ledger_.data();
  m.beta = static_cast<Real>(model_.beta);
  m.z = z_;
  return m;
}

template <class Real>
template <class Work>
void Tetrahedra<Real>::each(const ExplicitStep& step, std::size_t n, const Work& work) noexcept {
  if (step.team == nullptr || step.threads < 2) {
    for (std::size_t i = 0; i < n; ++i) work(i);
    return;
  }
  const std::size_t pieces = std::min(n, Team::most_pieces);
  step.team->each(pieces, step.threads, [&](std::size_t p) {
    for (std::size_t i = p * n / pieces; i < (p + 1) * n / pieces; ++i) work(i);
  });
}

template <class Real>
void Tetrahedra<Real>::elements(const TetContext<Real>& m, const ExplicitStep& step,
                                const TetSweep<Real>& sweep,
                                typename TetSweep<Real>::OfBlock kernel) noexcept {
  const std::size_t blocks = layout_.blocks.size();
  if (sweep.swell != nullptr) {
    each(step, blocks, [&](std::size_t b) { sweep.swell(m, b); });
    const auto shares = static_cast<Index>(layout_.node_of_share.size());
    each(step, elastic_of_shares_.size(), [&](std::size_t c) {
      sweep.average(m, c, std::min(static_cast<Index>(c + 1) * tet_chunk, shares));
    });
  }
  each(step, blocks, [&](std::size_t b) { kernel(m, b); });
}

template <class Real>
double Tetrahedra<Real>::elastic() const noexcept {
  const double of_tets = std::accumulate(elastic_.begin(), elastic_.end(), 0.0);
  return std::accumulate(elastic_of_shares_.begin(), elastic_of_shares_.end(), of_tets);
}

template <class Real>
StepOutcome Tetrahedra<Real>::step(const ExplicitStep& step, double kick) noexcept {
  TetContext<Real> m = context();
  for (std::size_t a = 0; a < 3; ++a) m.g[a] = static_cast<Real>(step.gravity[static_cast<Eigen::Index>(a)]);
  m.dt = static_cast<Real>(step.dt);
  m.kick = static_cast<Real>(kick);
  m.dt_before = static_cast<Real>(dt_before_);
  m.watch = step.watch;
  m.begins = kick != dt_before_;
  const bool damped = model_.beta > 0, apart = damped && step.struck;
  if (damped && since_ > 0) {
    for (std::size_t i = 0; i < 4 * n_nodes(); ++i)
      mean_v_[i] = (u_[i] - began_[i]) / static_cast<Real>(since_);
    m.v = mean_v_.data();
  }
  const TetSweep<Real>& sweep = this->sweep();
  elements(m, step, sweep, apart ? sweep.apart : step.watch ? sweep.watched_forces : sweep.forces);
  m.v = v_.data();
  note_way(kick, step.dt);
  const auto nodes = static_cast<Index>(n_nodes());
  const auto move = apart ? kernel_.move_apart : kernel_.move;
  each(step, ledger_.size(),
       [&](std::size_t c) { move(m, c, std::min(static_cast<Index>(c + 1) * tet_chunk, nodes)); });

  double of_damper = 0;
  for (const TetNodeLedger& chunk : ledger_) of_damper += chunk.of_damper, numerical_ += chunk.numerical;
  if (damped) {
    if (rate_known_ && apart && dt_before_ > 0)
      (of_damper > 0 ? passed_ : numerical_) += 0.5 * dt_before_ * of_damper;
    else
      passed_ += lost_by_power();
    std::swap(power_, power_before_);
    std::swap(mean_rate_, mean_rate_before_);
    rate_known_ = apart;
  }
  dt_before_ = kick;
  if (step.watch) {
    viscous_ = passed_;
    watch_ = {};
    watch_.elastic = elastic();
    double speed2 = 0;
    for (const TetNodeLedger& chunk : ledger_) {
      watch_.kinetic += chunk.kinetic;
      watch_.between += chunk.between;
      watch_.fallen += chunk.fallen;
      watch_.fallen_before += chunk.fallen_before;
      speed2 = std::max(speed2, chunk.speed2);
    }
    watch_.speed = std::sqrt(speed2);
    stiffening_ = std::ranges::max(stiffest_);
    least_of_all_J_ = std::min(least_of_all_J_, std::ranges::min(least_J_));
  }
  return {.stiffening = stiffening_, .least_corner_J = least_of_all_J_};
}

/// Before nodes move.
template <class Real>
void Tetrahedra<Real>::note_way(double kick, double dt) noexcept {
  since_ = 0;
  if (model_.beta == 0 || !(kick > 1.5 * dt)) return;
  since_ = dt;
  std::copy_n(u_.data(), 4 * n_nodes(), began_.data());
}

template <class Real>
StepOutcome Tetrahedra<Real>::drift(double dt) noexcept {
  if (since_ > 0) since_ += dt;
  const auto by = static_cast<Real>(dt);
  for (std::size_t n = 0; n < n_nodes(); ++n)
    if (inverse_mass_[n] > 0)
      for (std::size_t a = 4 * n; a < 4 * n + 4; ++a) u_[a] += by * v_[a];
  return {.stiffening = stiffening_, .least_corner_J = least_of_all_J_};
}

template <class Real>
double Tetrahedra<Real>::lost_by_power() const noexcept {
  return dt_before_ > 0 ? dt_before_ * std::accumulate(lost_.begin(), lost_.end(), 0.0) : 0;
}

template <class Real>
double Tetrahedra<Real>::inverse_mass(Index node) const noexcept {
  return static_cast<double>(inverse_mass_[static_cast<std::size_t>(node)]);
}

template <class Real>
void Tetrahedra<Real>::forces(std::vector<Vec3>& out) noexcept {
  elements(context(), {}, kernel_.elastic, kernel_.elastic.forces);
  for (std::size_t n = 0; n < n_nodes(); ++n) {
    out[n] = Vec3::Zero();
    for (Index e = layout_.of_node.begin[n]; e < layout_.of_node.begin[n + 1]; ++e)
      out[n] +=
          vector_at(force_, static_cast<std::size_t>(layout_.of_node.part[static_cast<std::size_t>(e)]));
  }
}

template class Tetrahedra<float>;
template class Tetrahedra<double>;

}  // namespace palpate::physics
