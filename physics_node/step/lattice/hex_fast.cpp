#include "physics_node/step/lattice/hex_fast.h"

#include <algorithm>
#include <cmath>

#include "physics_node/step/lattice/hex_kernel.h"

namespace palpate::physics {
namespace {

constexpr std::size_t batches_of_a_piece = 16, nodes_of_a_piece = 256;
// Why: below this a second thread costs as much as it saves.
constexpr std::size_t batches_worth_a_team = 64;

template <class Real>
Vec3 three(const Real* of) {
  return {static_cast<double>(of[0]), static_cast<double>(of[1]), static_cast<double>(of[2])};
}

/// Calls work(first, last) for pieces of [0, n).
template <class Work>
void in_pieces(const ExplicitStep& step, bool team, std::size_t n, std::size_t piece, const Work& work) {
  if (!team || step.team == nullptr || step.threads < 2) return work(0, n);
  step.team->each((n + piece - 1) / piece, step.threads,
                  [&](std::size_t p) { work(p * piece, std::min(n, (p + 1) * piece)); });
}

}  // namespace

template <class Real>
HexFast<Real>::HexFast(const Body& body, const LatticeState<Real>& state, const HexConstants<Real>& constants,
                       double at_rest)
    : kernel_(fast_kernel_here<Real>(
          {.law = body.solid->law, .physical = body.solid->hourglass == HourglassKind::physical})),
      longest_(body.solid->fast.step),
      at_rest_(at_rest),
      n_nodes_(state.fast.node.size()),
      n_batches_((body.solid->fast.cells.size() + fast_lanes - 1) / fast_lanes),
      lumps_(body, state.fast.node, state.fast.number) {
  index_cells(body, state);
  swept_ = ZeroedArray<Real>(static_cast<std::size_t>(body.capacity()));
  for (const Index node : body.nodes())
    swept_[static_cast<std::size_t>(node)] = state.inverse_mass[static_cast<std::size_t>(node)];
  for (const Index node : state.fast.node) {
    swept_[static_cast<std::size_t>(node)] = 0;
    inverse_mass_.push_back(body.inverse_mass[static_cast<std::size_t>(node)]);
    row_.push_back(body.lattice.row_of(node));
    rest_.push_back(body.rest_position(node));
  }
  for (Four* four : {&u_, &v_, &kick_, &sum_v_, &sum_sum_v_}) *four = Four(4 * n_nodes_);
  force_ = Four(forces_of_a_batch * n_batches_ + 3 * fast_lanes);
  dt_over_mass_.resize(n_nodes_);
  moves_.resize(n_nodes_);
  a_.resize(n_nodes_);
  u_before_.resize(n_nodes_);
  for (auto* vectors : {&place_, &moment_, &change_}) vectors->resize(n_nodes_);
  m_.corner = corner_.data(), m_.incident = incident_.data();
  m_.stiffness = stiffness_.data(), m_.power = power_.data(), m_.lost = lost_.data();
  m_.elastic = elastic_.data(), m_.least_change = least_change_.data(), m_.stiffest = stiffest_.data();
  m_.force = force_.data();
  m_.dt_over_mass = dt_over_mass_.data(), m_.kick = kick_.data();
  m_.u = u_.data(), m_.v = v_.data(), m_.sum_v = sum_v_.data(), m_.sum_sum_v = sum_sum_v_.data();
  m_.beta = static_cast<Real>(body.solid->beta);
  m_.k = constants;
  double largest = 0;
  for (const Index cell : body.solid->fast.cells)
    largest = std::max(largest, static_cast<double>(body.solid->stiffness[static_cast<std::size_t>(cell)]));
  m_.damper_weight =
      static_cast<Real>(hex_damper_weight(at_rest, body.solid->beta, fastest_of(body, at_rest, largest)));
}

template <class Real>
void HexFast<Real>::index_cells(const Body& body, const LatticeState<Real>& state) {
  const std::vector<Index>& cells = body.solid->fast.cells;
  const std::size_t n_lanes = fast_lanes * n_batches_;
  corner_.resize(8 * n_lanes);
  incident_.assign(8 * n_nodes_, static_cast<std::int32_t>(forces_of_a_batch * n_batches_));
  for (auto* lanes : {&stiffness_, &power_, &lost_, &elastic_, &least_change_, &stiffest_})
    lanes->assign(n_lanes, Real(0));
  std::vector<std::size_t> found(n_nodes_, 0);
  for (std::size_t l = 0; l < n_lanes; ++l) {
    const std::size_t of = std::min(l, cells.size() - 1), batch = l / fast_lanes, lane = l % fast_lanes;
    const std::array<Index, 8> corners = corners_of_cell(body.lattice, cells[of]);
    row_of_lane_.push_back(body.lattice.row_of(cells[of]));
    for (std::size_t a = 0; a < 8; ++a) {
      const std::int32_t n = state.fast.number[static_cast<std::size_t>(corners[a])];
      corner_[fast_lanes * (8 * batch + a) + lane] = 4 * n;
      if (l >= cells.size()) continue;
      const auto node = static_cast<std::size_t>(n);
      incident_[8 * node + found[node]++] =
          static_cast<std::int32_t>(forces_of_a_batch * batch + fast_lanes * 3 * a + lane);
    }
    if (l < cells.size())
      stiffness_[l] = static_cast<Real>(body.solid->stiffness[static_cast<std::size_t>(cells[of])]);
  }
}

template <class Real>
void HexFast<Real>::begin(LatticeState<Real>& state) noexcept {
  FastNodes<Real>& fast = state.fast;
  const auto dt = static_cast<Real>(state.dt_before);
  for (std::size_t n = 0; n < n_nodes_; ++n) {
    const auto c = static_cast<std::size_t>(fast.node[n]);
    for (std::size_t a = 0; a < 3; ++a) {
      if (dt == 0) fast.held[n][a] = fast.given[n][a] = 0;
      if (fast.held[n][a] != 0) {
        state.v[a][c] -= dt * fast.held[n][a];
        state.u[a][c] -= dt * dt * fast.held[n][a];
      }
      fast.held[n][a] = fast.given[n][a];
      fast.given[n][a] = 0;
      u_before_[n][a] = static_cast<double>(state.u[a][c]);
    }
  }
}

/// What swings stiffens twice a period: the number of substeps waits before it falls, as that of steps does.
template <class Real>
void HexFast<Real>::choose_substeps(double dt) noexcept {
  constexpr double wait_s = 0.2, most = 4096;
  const Real stiffest = *std::max_element(stiffest_.begin(), stiffest_.end());
  const double stiffening = static_cast<double>(stiffest) / at_rest_;
  if (h_ == 0) wanted_ = 1, wanted_for_ = 0;
  if (h_ > 0 && (stiffening >= wanted_ || wanted_for_ <= 0)) wanted_ = stiffening, wanted_for_ = wait_s;
  wanted_for_ -= dt;
  n_ = static_cast<int>(std::clamp(std::ceil(dt * wanted_ / longest_ - 1e-9), 1.0, most));
}

/// @return does any node move?
template <class Real>
bool HexFast<Real>::start(LatticeState<Real>& state, const ExplicitStep& step,
                          const Three<Real>& pulled) noexcept {
  const double dt = step.dt, h = dt / n_, lead = 0.5 * (dt - h);
  bool any = false;
  for (std::size_t n = 0; n < n_nodes_; ++n) {
    const auto c = static_cast<std::size_t>(state.fast.node[n]);
    const auto w = static_cast<Real>(inverse_mass_[n]);
    moves_[n] = inverse_mass_[n] > 0 && state.row_state[static_cast<std::size_t>(row_[n])] == RowState::awake;
    any = any || moves_[n] != 0;
    for (std::size_t a = 0; a < 3; ++a)
      a_[n][a] = w == 0 ? Real(0)
                        : pulled[a][c] * w + static_cast<Real>(step.gravity[static_cast<Eigen::Index>(a)]) +
                              state.fast.held[n][a];
  }
  for (std::size_t n = 0; n < n_nodes_; ++n)
    for (std::size_t a = 0; a < 3; ++a) {
      u_[4 * n + a] = static_cast<Real>(u_before_[n][a]);
      v_[4 * n + a] = state.fast.ahead[n][a];
    }
  if (state.dt_before == 0) begin_anew(lead);
  for (std::size_t n = 0; n < n_nodes_; ++n) {
    const auto c = static_cast<std::size_t>(state.fast.node[n]);
    const bool moves = moves_[n] != 0;
    dt_over_mass_[n] = moves ? static_cast<Real>(h * inverse_mass_[n]) : Real(0);
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t i = 4 * n + a;
      v_[i] = moves ? state.v[a][c] + v_[i] + static_cast<Real>(lead) * a_[n][a] : Real(0);
      kick_[i] = moves ? static_cast<Real>(h) * a_[n][a] : Real(0);
      sum_v_[i] = sum_sum_v_[i] = 0;
    }
  }
  return any;
}

template <class Real>
template <class Moment>
void HexFast<Real>::turn(const Real* u, const Moment& moment, Four& velocity) noexcept {
  for (std::size_t n = 0; n < n_nodes_; ++n) {
    place_[n] = rest_[n] + three(u + 4 * n);
    moment_[n] = moves_[n] == 0 ? Vec3(Vec3::Zero()) : Vec3(moment(n) / inverse_mass_[n]);
  }
  lumps_.turn(moves_, place_, moment_, change_);
  for (std::size_t n = 0; n < n_nodes_; ++n)
    for (std::size_t a = 0; a < 3; ++a)
      velocity[4 * n + a] += static_cast<Real>(change_[n][static_cast<Eigen::Index>(a)]);
}

/// The moment of a about the origin is that at the beginning of the step, not that of where nodes went meanwhile:
///   sum of m [(H - h)/2 x + h sum of x_j - (H - h)/2 x' - H x] x a   is too much.
template <class Real>
void HexFast<Real>::turn_back(double dt) noexcept {
  if (n_ == 1) return;
  const double h = dt / n_, lead = 0.5 * (dt - h);
  const auto moment = [&](std::size_t n) {
    const Vec3 lever = h * h * three(sum_sum_v_.data() + 4 * n) - lead * h * three(sum_v_.data() + 4 * n);
    return Vec3(lever.cross(three(a_[n].data())));
  };
  turn(u_.data(), moment, v_);
}

/// No step came before: each lump begins with its momenta, and as if what pulls its nodes apart had done so for long.
template <class Real>
void HexFast<Real>::begin_anew(double lead) noexcept {
  for (std::size_t n = 0; n < n_nodes_; ++n) change_[n] = three(a_[n].data());
  lumps_.subtract_mean(change_);
  for (std::size_t n = 0; n < n_nodes_; ++n)
    for (std::size_t a = 0; a < 3; ++a)
      v_[4 * n + a] =
          moves_[n] == 0 ? Real(0) : static_cast<Real>(-lead * change_[n][static_cast<Eigen::Index>(a)]);
  turn(
      u_.data(), [&](std::size_t n) { return Vec3(place_[n].cross(three(v_.data() + 4 * n))); }, v_);
}

template <class Real>
void HexFast<Real>::substep(const ExplicitStep& step, bool watched) noexcept {
  const bool team = n_batches_ >= batches_worth_a_team;
  const auto forces = watched ? kernel_.watched_forces : kernel_.forces;
  in_pieces(step, team, n_batches_, batches_of_a_piece,
            [&](std::size_t first, std::size_t last) { forces(m_, first, last); });
}

template <class Real>
std::array<double, 3> HexFast<Real>::force_on(std::size_t n) const noexcept {
  std::array<double, 3> sum{};
  for (std::size_t i = 0; i < 8; ++i)
    for (std::size_t a = 0; a < 3; ++a)
      sum[a] += static_cast<double>(force_[static_cast<std::size_t>(incident_[8 * n + i]) + fast_lanes * a]);
  return sum;
}

/// When the first forces of a step are there: what rows are told of it before it moves anything, and what another step than the
/// last takes of K.
template <class Real>
void HexFast<Real>::look(LatticeState<Real>& state, const ExplicitStep& step, double dt_before,
                         double h_before) noexcept {
  const double h = step.dt / n_, lead = 0.5 * (step.dt - h), lead_before = 0.5 * (dt_before - h_before);
  const bool begins = step.dt != dt_before || h != h_before;
  for (std::size_t n = 0; n < n_nodes_; ++n) {
    if (inverse_mass_[n] == 0) continue;
    RowLedger& ledger = state.ledger[static_cast<std::size_t>(row_[n])];
    const std::array<double, 3> f = force_on(n);
    const auto c = static_cast<std::size_t>(state.fast.node[n]);
    double a2 = 0, now = 0, before = 0, fallen = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double all = static_cast<double>(a_[n][a]) + f[a] * inverse_mass_[n];
      const double own = all - static_cast<double>(state.fast.held[n][a]);
      const double v = static_cast<double>(v_[4 * n + a]);
      const double v_before = dt_before == 0 ? static_cast<double>(state.v[a][c])
                                             : v + (lead_before - lead) * static_cast<double>(a_[n][a]);
      a2 += own * own;
      now += v * (v + h * own);
      before += v_before * (v_before + h_before * own);
      fallen += u_before_[n][a] * step.gravity[static_cast<Eigen::Index>(a)];
    }
    const RowState row = state.row_state[static_cast<std::size_t>(row_[n])];
    if (step.watch && (row == RowState::awake || row == RowState::rim))
      ledger.acceleration2 = std::max(ledger.acceleration2, a2);
    if (moves_[n] == 0) continue;
    if (begins) ledger.numerical += 0.5 / inverse_mass_[n] * (before - now);
    if (!step.watch) continue;
    ledger.between += 0.5 / inverse_mass_[n] * now;
    ledger.fallen_before += fallen / inverse_mass_[n];
  }
  if (!step.watch) return;
  Real least = 0;
  for (std::size_t l = 0; l < stiffness_.size(); ++l) {
    if (stiffness_[l] == 0) continue;
    least = std::min(least, least_change_[l]);
    const auto r = static_cast<std::size_t>(row_of_lane_[l]);
    if (state.row_state[r] != RowState::asleep) state.ledger[r].elastic += static_cast<double>(elastic_[l]);
  }
  least_corner_J_ = std::min(least_corner_J_, 1 + static_cast<double>(least));
}

template <class Real>
void HexFast<Real>::finish(LatticeState<Real>& state, const ExplicitStep& step) noexcept {
  const double lead = 0.5 * (step.dt - step.dt / n_);
  turn_back(step.dt);
  for (std::size_t n = 0; n < n_nodes_; ++n) {
    if (moves_[n] == 0) continue;
    const auto c = static_cast<std::size_t>(state.fast.node[n]);
    double v2 = 0, mean2 = 0, fallen = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const std::size_t i = 4 * n + a;
      const Real mean = sum_v_[i] / static_cast<Real>(n_);
      state.u[a][c] = u_[i];
      state.v[a][c] = mean;
      state.fast.ahead[n][a] = v_[i] - static_cast<Real>(lead) * a_[n][a] - mean;
      v2 += static_cast<double>(v_[i]) * static_cast<double>(v_[i]);
      mean2 += static_cast<double>(mean) * static_cast<double>(mean);
      fallen += static_cast<double>(u_[i]) * step.gravity[static_cast<Eigen::Index>(a)];
    }
    if (!step.watch) continue;
    RowLedger& ledger = state.ledger[static_cast<std::size_t>(row_[n])];
    ledger.speed2 = std::max({ledger.speed2, v2, mean2});
    ledger.kinetic += 0.5 / inverse_mass_[n] * v2;
    ledger.fallen += fallen / inverse_mass_[n];
  }
}

template <class Real>
void HexFast<Real>::book(LatticeState<Real>& state, const ExplicitStep& step,
                         std::vector<double>& passed) noexcept {
  for (std::size_t l = 0; l < lost_.size(); ++l) {
    if (lost_[l] == 0) continue;
    passed[static_cast<std::size_t>(row_of_lane_[l])] += static_cast<double>(lost_[l]);
    lost_[l] = 0;
  }
  if (!step.watch) return;
  for (const Index row : row_of_lane_)
    state.ledger[static_cast<std::size_t>(row)].viscous = passed[static_cast<std::size_t>(row)];
}

template <class Real>
void HexFast<Real>::step(LatticeState<Real>& state, const ExplicitStep& step, const Three<Real>& pulled,
                         std::vector<double>& passed) noexcept {
  if (state.dt_before == 0) h_ = 0;
  gravity_ = step.gravity;
  if (std::ranges::all_of(row_, [&](Index row) {
        return state.row_state[static_cast<std::size_t>(row)] == RowState::asleep;
      })) {
    std::ranges::fill(power_, Real(0));
    return;
  }
  choose_substeps(step.dt);
  const double h = step.dt / n_;
  const double dt_before = state.dt_before, h_before = h_;
  m_.dt = static_cast<Real>(h);
  m_.dt_before = static_cast<Real>(h_before);
  const bool any = start(state, step, pulled);
  std::ranges::fill(stiffest_, Real(0));
  for (int j = 0; j < (any ? n_ : 1); ++j) {
    if (j == 1) m_.dt_before = m_.dt;
    const bool watched = j == 0 && step.watch;
    substep(step, watched);
    if (j == 0 && (step.watch || dt_before != step.dt || h_before != h))
      look(state, step, dt_before, h_before);
    if (any)
      in_pieces(step, n_batches_ >= batches_worth_a_team, n_nodes_, nodes_of_a_piece,
                [&](std::size_t first, std::size_t last) { kernel_.move(m_, first, last); });
  }
  finish(state, step);
  book(state, step, passed);
  h_ = h;
}

template <class Real>
Three<Real> HexFast<Real>::velocities(const Body& body, const LatticeState<Real>& state, const Vec3& gravity,
                                      const MeasuredHexahedra& rest) const {
  Three<Real> v;
  for (auto& axis : v) axis = ZeroedArray<Real>(static_cast<std::size_t>(body.capacity()));
  const double lead = state.dt_before == 0 ? 0 : 0.5 * (state.dt_before - h_);
  for (std::size_t n = 0; n < n_nodes_; ++n) {
    if (inverse_mass_[n] == 0) continue;
    const auto c = static_cast<std::size_t>(state.fast.node[n]);
    for (std::size_t a = 0; a < 3; ++a) {
      const auto e = static_cast<Eigen::Index>(a);
      const double outer = static_cast<double>(state.fast.held[n][a] + state.fast.given[n][a]);
      const double ahead = state.dt_before == 0 ? 0 : static_cast<double>(state.fast.ahead[n][a]);
      v[a][c] = static_cast<Real>(static_cast<double>(state.v[a][c]) + ahead +
                                  lead * (rest.force[c][e] * inverse_mass_[n] + gravity[e] + outer));
    }
  }
  return v;
}

template <class Real>
void HexFast<Real>::add(const Body& body, const HexGrid& grid, const LatticeState<Real>& state,
                        const Vec3& gravity, const MeasuredHexahedra& rest, Energies& sum) const {
  const Three<Real> v = velocities(body, state, gravity, rest);
  const MeasuredHexahedra own = measure_hexahedra(body, grid, state, CellsOf::fast, v);
  sum.elastic += own.elastic;
  const double h = state.dt_before == 0 ? 0 : h_;
  for (std::size_t n = 0; n < n_nodes_; ++n) {
    if (inverse_mass_[n] == 0) continue;
    const auto c = static_cast<std::size_t>(state.fast.node[n]);
    const Vec3 now = vector_of(v, state.fast.node[n]);
    const Vec3 a = (rest.force[c] + own.force[c]) * inverse_mass_[n] + gravity;
    sum.kinetic += 0.5 / inverse_mass_[n] * now.squaredNorm();
    sum.between += 0.5 / inverse_mass_[n] * now.dot(now + h * a);
  }
}

template <class Real>
double HexFast<Real>::due(const Body& body, const HexGrid& grid, const LatticeState<Real>& state,
                          const MeasuredHexahedra& rest) const {
  const Three<Real> v = velocities(body, state, gravity_, rest);
  const MeasuredHexahedra own = measure_hexahedra(body, grid, state, CellsOf::fast, v);
  double sum = 0;
  for (std::size_t l = 0; l < own.power_of_cell.size(); ++l)
    sum += damper_loss(h_, static_cast<double>(power_[l]), own.power_of_cell[l]);
  return sum;
}

template class HexFast<float>;
template class HexFast<double>;

}  // namespace palpate::physics
