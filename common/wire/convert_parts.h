#pragma once
// The small steps that all conversions share. For common/wire only.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace palpate::wire_parts {

inline constexpr double unit_tolerance = 1e-3;
// No hand is beyond these. A changed bit makes finite numbers, too, of which a force of 1e200 N is one.
inline constexpr double farthest = 1e3;      // [m], [m/s]
inline constexpr double fastest_turn = 1e6;  // [rad/s]
inline constexpr double strongest = 1e3;     // [N], [N m]

inline bool finite(double value) noexcept { return std::isfinite(value); }
inline bool finite(float value) noexcept { return std::isfinite(value); }

/// All numbers of the first `n` elements of an array of numbers or of arrays.
template <class T, std::size_t N>
bool finite(const T (&values)[N], std::size_t n = N) noexcept {
  return std::all_of(values, values + std::min(n, N), [](const auto& value) { return finite(value); });
}

/// No number is larger than `limit`. False if anything is not finite.
template <std::size_t N>
bool within(const double (&values)[N], double limit) noexcept {
  return std::all_of(values, values + N, [limit](double value) { return std::abs(value) <= limit; });
}

/// Length one within the tolerance. False if anything is not finite.
template <std::size_t N>
bool unit(const double (&values)[N]) noexcept {
  double squared = 0;
  for (const double value : values) squared += value * value;
  return std::abs(std::sqrt(squared) - 1.0) <= unit_tolerance;
}

/// Nothing but zeros.
template <std::size_t N>
bool zero(const double (&values)[N]) noexcept {
  return std::all_of(values, values + N, [](double value) { return value == 0; });
}

/// A zero stands somewhere in the array.
template <std::size_t N>
bool ends(const std::uint8_t (&text)[N]) noexcept {
  return std::memchr(text, 0, N) != nullptr;
}

/// Copies the first `n` elements between arrays of the same shape (std::array of numbers or of arrays on one side,
/// a plain array on the other), never beyond their end.
template <class To, class From>
void copy(const From& from, To& to, std::size_t n = SIZE_MAX) noexcept {
  static_assert(std::is_trivially_copyable_v<From> && std::is_trivially_copyable_v<To>);
  static_assert(sizeof(From) == sizeof(To), "arrays of the same shape");
  constexpr std::size_t element = sizeof(from[0]);
  static_assert(element == sizeof(to[0]), "arrays of the same shape");
  std::memcpy(&to, &from, std::min(n, sizeof(From) / element) * element);
}

}  // namespace palpate::wire_parts
