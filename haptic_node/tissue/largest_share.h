#pragma once
// The largest part of a correction that may be taken at once.

namespace palpate::haptic {

/// By halving [0, most], where `most` itself does not fit and all below some share do: at most most / 2^halvings too small.
/// @param fits  (double share) -> bool
template <class Fits>
double largest_share(double most, int halvings, const Fits& fits) noexcept {
  double low = 0, high = most;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (fits(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace palpate::haptic
