#pragma once
// The two constants of an isotropic elastic material.

namespace palpate::physics {

struct Lame {
  double mu = 0, lambda = 0;  // [Pa]
};

/// @param modulus  Young's [Pa]  @param poisson_ratio  below 0.5
constexpr Lame lame_of(double modulus, double poisson_ratio) noexcept {
  return {.mu = modulus / (2 * (1 + poisson_ratio)),
          .lambda = modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio))};
}

/// Of waves of pressure: lambda + 2 mu [Pa].
constexpr double p_wave_modulus(const Lame& lame) noexcept { return lame.lambda + 2 * lame.mu; }

}  // namespace palpate::physics
