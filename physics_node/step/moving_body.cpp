#include "physics_node/step/moving_body.h"

#include <cmath>

#include "common/math/hash.h"
#include "physics_node/step/element_step.h"
#include "physics_node/step/measure.h"
#include "physics_node/step/state.h"

namespace palpate::physics {
namespace {

template <class Real>
class LatticeBody final : public MovingBody {
 public:
  explicit LatticeBody(Body body)
      : body_(std::move(body)), state_(body_), saved_u_(rest()), saved_v_(rest()) {}

  const Body& body() const noexcept override { return body_; }

  void element_forces_and_integrate(double dt, const Vec3& gravity, int threads) noexcept override {
    element_step(body_, state_, dt, gravity, threads);
  }

  void kick(std::span<const NodalForce> forces, double dt) noexcept override {
    for (const auto& nodal : forces) {
      const auto c = static_cast<std::size_t>(nodal.cell);
      for (std::size_t a = 0; a < 3; ++a) {
        const Real dv =
            static_cast<Real>(dt * nodal.force[static_cast<Eigen::Index>(a)]) * state_.inverse_mass[c];
        state_.v[a][c] += dv;
        state_.u[a][c] += static_cast<Real>(dt) * dv;
      }
    }
  }

  std::int64_t bounce_off_floor(double height) noexcept override {
    std::int64_t bounced = 0;
    for (const Index cell : body_.lattice.masses) {
      const auto c = static_cast<std::size_t>(cell);
      if (state_.v[2][c] >= 0 || position(cell).z() >= height) continue;
      state_.v[2][c] = -state_.v[2][c];
      ++bounced;
    }
    return bounced;
  }

  std::int64_t yield_and_break(int threads) noexcept override {
    return palpate::physics::yield_and_break(body_, state_, threads);
  }

  bool is_finite() const noexcept override {
    // NaN and infinity survive multiplication by zero, so one sum tells of all.
    Real sum = 0;
    for (const auto& row : body_.lattice.rows)
      for (std::size_t a = 0; a < 3; ++a)
        for (Index i = row.first; i < row.first + row.count; ++i)
          sum +=
              Real(0) * (state_.u[a][static_cast<std::size_t>(i)] + state_.v[a][static_cast<std::size_t>(i)]);
    return sum == Real(0);
  }

  void save() noexcept override { copy_masses(state_.u, saved_u_), copy_masses(state_.v, saved_v_); }

  void restore() noexcept override {
    copy_masses(saved_u_, state_.u);
    for (const Index cell : body_.lattice.masses)
      for (std::size_t a = 0; a < 3; ++a) state_.v[a][static_cast<std::size_t>(cell)] = 0;
  }

  void reset() noexcept override {
    state_.reset(body_);
    save();
  }

  void place(Index cell, const Vec3& displacement, const Vec3& velocity) noexcept override {
    const auto c = static_cast<std::size_t>(cell);
    if (state_.inverse_mass[c] == 0) return;
    for (std::size_t a = 0; a < 3; ++a) {
      state_.u[a][c] = static_cast<Real>(displacement[static_cast<Eigen::Index>(a)]);
      state_.v[a][c] = static_cast<Real>(velocity[static_cast<Eigen::Index>(a)]);
    }
  }

  Vec3 position(Index cell) const noexcept override {
    return body_.lattice.rest_position(cell) + vector_of(state_.u, cell);
  }
  Vec3 displacement(Index cell) const noexcept override { return vector_of(state_.u, cell); }
  Vec3 velocity(Index cell) const noexcept override { return vector_of(state_.v, cell); }
  Mask mask(Index cell) const noexcept override { return state_.mask[static_cast<std::size_t>(cell)]; }
  std::uint8_t flags(Index cell) const noexcept override {
    return state_.flags[static_cast<std::size_t>(cell)];
  }

  Energies energies(const Vec3& gravity) const override { return measure_energies(body_, state_, gravity); }
  Momenta momenta() const override { return measure_momenta(body_, state_); }
  BodyCounts counts() const override { return measure_counts(body_, state_); }

  std::uint64_t hash(std::uint64_t seed) const noexcept override {
    for (const auto& row : body_.lattice.rows) {
      const auto first = static_cast<std::size_t>(row.first);
      const auto count = static_cast<std::size_t>(row.count);
      for (std::size_t a = 0; a < 3; ++a) {
        seed = hash_bytes(&state_.u[a][first], count * sizeof(Real), seed);
        seed = hash_bytes(&state_.v[a][first], count * sizeof(Real), seed);
      }
      seed = hash_bytes(&state_.mask[first], count * sizeof(Mask), seed);
      if (!body_.law.yields) continue;
      for (std::size_t d = 0; d < static_cast<std::size_t>(body_.lattice.n_half); ++d) {
        seed = hash_bytes(&state_.l_c[d][first], count * sizeof(Real), seed);
        seed = hash_bytes(&state_.y_p[d][first], count * sizeof(Real), seed);
      }
    }
    return seed;
  }

 private:
  Three<Real> rest() const {
    Three<Real> three;
    for (auto& array : three) array = ZeroedArray<Real>(static_cast<std::size_t>(body_.lattice.n_cells()));
    return three;
  }
  void copy_masses(const Three<Real>& from, Three<Real>& to) noexcept {
    for (const auto& row : body_.lattice.rows)
      for (std::size_t a = 0; a < 3; ++a)
        std::copy_n(&from[a][static_cast<std::size_t>(row.first)], row.count,
                    &to[a][static_cast<std::size_t>(row.first)]);
  }
  static Vec3 vector_of(const Three<Real>& three, Index cell) noexcept {
    const auto c = static_cast<std::size_t>(cell);
    return {static_cast<double>(three[0][c]), static_cast<double>(three[1][c]),
            static_cast<double>(three[2][c])};
  }

  Body body_;
  LatticeState<Real> state_;
  Three<Real> saved_u_, saved_v_;
};

}  // namespace

std::unique_ptr<MovingBody> make_moving_body(Body body, Precision precision) {
  if (precision == Precision::single_) return std::make_unique<LatticeBody<float>>(std::move(body));
  return std::make_unique<LatticeBody<double>>(std::move(body));
}

}  // namespace palpate::physics
