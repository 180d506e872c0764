#include "physics_node/step/lattice/hex_meter.h"

#include "physics_node/material/st_venant_kirchhoff.h"
#include "physics_node/material/stable_neo_hookean.h"

namespace palpate::physics {

/// A cell at one instant, measured for the books.
struct MeasuredCell {
  HexForces<Scalar<double>> forces;
  double lost_before = 0;  // by its terms since the last step [J]
};

/// Measures cells of one state one by one, in double.
template <class Real>
class HexCellMeter {
 public:
  using One = Scalar<double>;

  HexCellMeter(const Body& body, const LatticeState<Real>& state)
      : body_(body),
        state_(state),
        k_(hex_constants_of<double>(body)),
        terms_(relaxation_terms<double>(body, state.dt_before, 0)) {}

  /// @param beta  at u + beta v
  MeasuredCell at(const std::array<Index, 8>& corner, double beta) const {
    Corners<One> w;
    for (std::size_t a = 0; a < 8; ++a) {
      const Vec3 x = vector_of(state_.u, corner[a]) + beta * vector_of(state_.v, corner[a]);
      for (std::size_t c = 0; c < 3; ++c) w[c][a] = x[static_cast<Eigen::Index>(c)];
    }
    MeasuredCell now;
    const std::size_t n_terms = body_.solid->relaxation.size();
    if (n_terms > 0) {
      std::array<Remembered<double>, most_relaxations> remembered;
      for (std::size_t t = 0; t < n_terms; ++t)
        for (std::size_t n = 0; n < n_remembered; ++n)
          remembered[t][n] = static_cast<double>(
              state_.remembered[n_remembered * t + n][static_cast<std::size_t>(corner[0])]);
      Relaxing<One, double> memory{{terms_.data(), n_terms}, remembered};
      hex_forces<One, StableNeoHookean, true, true>(k_, w, now.forces, memory);
      now.lost_before = memory.lost_before;
    } else if (body_.solid->law == TissueLaw::green) {
      lasting<StVenantKirchhoff>(w, now.forces);
    } else {
      lasting<StableNeoHookean>(w, now.forces);
    }
    return now;
  }

 private:
  template <template <class> class Law>
  void lasting(const Corners<One>& w, HexForces<One>& out) const {
    if (body_.solid->hourglass == HourglassKind::physical)
      hex_forces<One, Law, true, true>(k_, w, out);
    else
      hex_forces<One, Law, false, true>(k_, w, out);
  }

  const Body& body_;
  const LatticeState<Real>& state_;
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
MeasuredHexahedra measure_hexahedra(const Body& body, const HexGrid& grid, const LatticeState<Real>& state) {
  MeasuredHexahedra sum;
  sum.force.assign(static_cast<std::size_t>(body.capacity()), Vec3::Zero());
  const HexCellMeter<Real> meter(body, state);
  for_each_cell(body, grid, state, [&](double stiffness, const std::array<Index, 8>& corner) {
    const MeasuredCell now = meter.at(corner, body.solid->beta);
    const auto& out = now.forces;
    const double at_u = meter.at(corner, 0).forces.energy;
    sum.elastic += stiffness * at_u;
    sum.ahead += stiffness * (out.energy - at_u);
    sum.lost_before += stiffness * now.lost_before;
    for (std::size_t a = 0; a < 8; ++a)
      sum.force[static_cast<std::size_t>(corner[a])] +=
          stiffness * Vec3(out.f[0][a], out.f[1][a], out.f[2][a]);
  });
  return sum;
}

template MeasuredHexahedra measure_hexahedra(const Body&, const HexGrid&, const LatticeState<float>&);
template MeasuredHexahedra measure_hexahedra(const Body&, const HexGrid&, const LatticeState<double>&);

}  // namespace palpate::physics
