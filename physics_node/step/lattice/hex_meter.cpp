#include "physics_node/step/lattice/hex_meter.h"

#include "physics_node/material/st_venant_kirchhoff.h"
#include "physics_node/material/stable_neo_hookean.h"
#include "physics_node/step/lattice/hex_yield.h"

namespace palpate::physics {

/// A cell at one instant, measured for the books.
struct MeasuredCell {
  HexForces<Scalar<double>> forces;
  double lost_before = 0;  // by its terms since the last step [J]
  double power = 0;        // that its damper takes [W]
  Corners<Scalar<double>> of_rate{};
};

/// Measures cells of one state one by one, in double.
template <class Real>
class HexCellMeter {
 public:
  using One = Scalar<double>;

  HexCellMeter(const Body& body, const LatticeState<Real>& state, const Three<Real>& v)
      : body_(body),
        state_(state),
        v_(v),
        k_(hex_constants_of<double>(body)),
        terms_(relaxation_terms<double>(body, state.dt_before, 0)) {}

  MeasuredCell at(const std::array<Index, 8>& corner, Index cell) const {
    Corners<One> w, v;
    for (std::size_t a = 0; a < 8; ++a) {
      const Vec3 x = vector_of(state_.u, corner[a]), moves = vector_of(v_, corner[a]);
      for (std::size_t c = 0; c < 3; ++c) {
        w[c][a] = x[static_cast<Eigen::Index>(c)];
        v[c][a] = moves[static_cast<Eigen::Index>(c)];
      }
    }
    MeasuredCell now;
    const Damping<One, double> damping{.beta = body_.solid->beta, .v = &v};
    const std::size_t n_terms = body_.solid->relaxation.size();
    if (n_terms > 0) {
      std::array<Remembered<double>, most_relaxations> remembered;
      for (std::size_t t = 0; t < n_terms; ++t)
        for (std::size_t n = 0; n < n_remembered; ++n)
          remembered[t][n] =
              static_cast<double>(state_.remembered[n_remembered * t + n][static_cast<std::size_t>(cell)]);
      RelaxingAndDamped<One, double> memory{{{terms_.data(), n_terms}, remembered}, damping};
      hex_forces<One, StableNeoHookean, true, true>(k_, w, now.forces, memory);
      now.lost_before = memory.relaxing.lost_before;
      now.power = memory.damping.power;
      memory.damping.forces(k_, now.of_rate);
    } else if (body_.solid->law == TissueLaw::green) {
      lasting<StVenantKirchhoff>(w, damping, now);
    } else {
      lasting<StableNeoHookean>(w, damping, now);
    }
    if (any_cells_yield(body_)) add_plastic(k_, w, plastic_of(state_, cell), now.forces);
    return now;
  }

 private:
  template <template <class> class Law>
  void lasting(const Corners<One>& w, Damping<One, double> damping, MeasuredCell& now) const {
    if (body_.solid->hourglass == HourglassKind::physical)
      hex_forces<One, Law, true, true>(k_, w, now.forces, damping);
    else
      hex_forces<One, Law, false, true>(k_, w, now.forces, damping);
    now.power = damping.power;
    damping.forces(k_, now.of_rate);
  }

  const Body& body_;
  const LatticeState<Real>& state_;
  const Three<Real>& v_;
  HexConstants<double> k_;
  std::array<RelaxationTerm<double>, most_relaxations> terms_;
};

double hex_bound_at_rest(const Body& body) {
  using One = Scalar<double>;
  const HexConstants<double> k = hex_constants_of<double>(body);
  if (body.solid->law == TissueLaw::green) return StVenantKirchhoff<One>{k.mu, k.lambda}.stiffness({});
  auto terms = relaxation_terms<double>(body, 0, 0);
  const Relaxing<One, double> memory{{terms.data(), body.solid->relaxation.size()}, {}};
  return memory.stiffness(StableNeoHookean<One>{k.mu, k.lambda}.stiffness({}), k, {});
}

template <class Real>
MeasuredHexahedra measure_hexahedra(const Body& body, const HexGrid& grid, const LatticeState<Real>& state,
                                    CellsOf which, const Three<Real>& v,
                                    std::span<const double> broken_soon) {
  MeasuredHexahedra sum;
  // Memory is touched only at the nodes of cells that are measured.
  sum.force = ZeroedArray<Vec3>(static_cast<std::size_t>(body.capacity()));
  sum.force_of_rate = ZeroedArray<Vec3>(sum.force.size());
  sum.power.assign(grid.runs.size() + 1, 0);
  const HexCellMeter<Real> meter(body, state, v);
  for_each_strained_cell(
      body, grid, state,
      [&](double now_stiff, const std::array<Index, 8>& corner, std::size_t run, Index cell) {
        const bool is_fast = state.fast.has_cell(cell);
        if (is_fast != (which == CellsOf::fast)) return;
        const auto c = static_cast<std::size_t>(cell);
        const double soon = broken_soon.empty() ? 0 : broken_soon[c];
        const double stiffness = now_stiff - soon * static_cast<double>(body.solid->stiffness[c]);
        const MeasuredCell now = meter.at(corner, cell);
        const auto& out = now.forces;
        sum.elastic += stiffness * out.energy;
        sum.lost_before += stiffness * now.lost_before;
        sum.power[run] += stiffness * now.power;
        if (is_fast) sum.power_of_cell.push_back(stiffness * now.power);
        for (std::size_t a = 0; a < 8; ++a) {
          const auto node = static_cast<std::size_t>(corner[a]);
          sum.force[node] += stiffness * Vec3(out.f[0][a], out.f[1][a], out.f[2][a]);
          sum.force_of_rate[node] +=
              stiffness * Vec3(now.of_rate[0][a], now.of_rate[1][a], now.of_rate[2][a]);
        }
      });
  return sum;
}

template <class Real>
double measure_elastic(const Body& body, const HexGrid& grid, const LatticeState<Real>& state,
                       const HexFailure<Real>* failure) noexcept {
  double sum = 0;
  const HexCellMeter<Real> meter(body, state, state.v);
  for_each_strained_cell(
      body, grid, state, [&](double stiffness, const std::array<Index, 8>& corner, std::size_t, Index cell) {
        if (failure != nullptr)
          stiffness -= failure->due_of(state, cell) *
                       static_cast<double>(body.solid->stiffness[static_cast<std::size_t>(cell)]);
        sum += stiffness * meter.at(corner, cell).forces.energy;
      });
  return sum;
}

template <class Real>
double measure_between(const Body& body, const HexGrid& grid, const LatticeState<Real>& state,
                       std::span<const Index> runs) noexcept {
  double sum = 0;
  const HexCellMeter<Real> meter(body, state, state.v);
  for (const Index r : runs)
    for_each_cell_of(body, grid, state, static_cast<std::size_t>(r),
                     [&](double stiffness, const std::array<Index, 8>& corner, std::size_t, Index cell) {
                       const MeasuredCell now = meter.at(corner, cell);
                       double power = 0;
                       for (std::size_t a = 0; a < 8; ++a)
                         for (std::size_t c = 0; c < 3; ++c)
                           power += (now.forces.f[c][a] - now.of_rate[c][a]) *
                                    static_cast<double>(state.v[c][static_cast<std::size_t>(corner[a])]);
                       sum += stiffness * (now.forces.energy + 0.5 * state.dt_before * power);
                     });
  return sum;
}

template double measure_between(const Body&, const HexGrid&, const LatticeState<float>&,
                                std::span<const Index>) noexcept;
template double measure_between(const Body&, const HexGrid&, const LatticeState<double>&,
                                std::span<const Index>) noexcept;
template double measure_elastic(const Body&, const HexGrid&, const LatticeState<float>&,
                                const HexFailure<float>*) noexcept;
template double measure_elastic(const Body&, const HexGrid&, const LatticeState<double>&,
                                const HexFailure<double>*) noexcept;
template MeasuredHexahedra measure_hexahedra(const Body&, const HexGrid&, const LatticeState<float>&, CellsOf,
                                             const Three<float>&, std::span<const double>);
template MeasuredHexahedra measure_hexahedra(const Body&, const HexGrid&, const LatticeState<double>&,
                                             CellsOf, const Three<double>&, std::span<const double>);

}  // namespace palpate::physics
