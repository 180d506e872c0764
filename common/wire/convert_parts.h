#pragma once
// The small steps that all conversions share. For common/wire only.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "common/wire/convert.h"

namespace palpate::wire_parts {

inline constexpr double unit_tolerance = 1e-3;

inline bool finite(double value) noexcept { return std::isfinite(value); }
inline bool finite(float value) noexcept { return std::isfinite(value); }

/// All numbers of the first `n` elements of an array of numbers or of arrays.
template <class T, std::size_t N>
bool finite(const T (&values)[N], std::size_t n = N) noexcept {
  return std::all_of(values, values + std::min(n, N), [](const auto& value) { return finite(value); });
}

/// No number is larger than `limit`. False if anything is not finite.
inline bool within(double value, double limit) noexcept { return std::abs(value) <= limit; }
template <class T, std::size_t N>
bool within(const T (&values)[N], double limit, std::size_t n = N) noexcept {
  return std::all_of(values, values + std::min(n, N),
                     [limit](const auto& value) { return within(value, limit); });
}

/// Nothing but zeros.
template <std::size_t N>
bool zero(const double (&values)[N]) noexcept {
  return std::all_of(values, values + N, [](double value) { return value == 0; });
}

/// `n` things from `first` on lie within `total`, whatever the 32-bit sums would do.
inline bool ends_by(std::uint64_t first, std::uint64_t n, std::uint64_t total) noexcept {
  return first + n <= total;
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

/// The first promise of a sample that is broken, looked for in order.
class Check {
 public:
  explicit Check(std::uint32_t version) noexcept {
    that(version == wire_version, RejectReason::version, "version");
  }
  Check() = default;

  Check& that(bool kept, RejectReason reason, const char* field) noexcept {
    if (!kept && !verdict_) verdict_ = Broken{reason, field};
    return *this;
  }
  /// Finite and not beyond the limit, either side of zero.
  template <class T>
  Check& bounded(const T& value, double limit, const char* field) noexcept {
    if (verdict_ || within(value, limit)) return *this;
    return that(false, finite(value) ? RejectReason::out_of_range : RejectReason::not_finite, field);
  }
  /// The same of the first `n` elements.
  template <class T, std::size_t N>
  Check& bounded(const T (&values)[N], double limit, const char* field, std::size_t n) noexcept {
    if (verdict_ || within(values, limit, n)) return *this;
    return that(false, finite(values, n) ? RejectReason::out_of_range : RejectReason::not_finite, field);
  }
  /// Finite, from 0 to the limit.
  Check& positive(double value, double limit, const char* field) noexcept {
    return bounded(value, limit, field).that(!(value < 0), RejectReason::out_of_range, field);
  }
  /// Length one within the tolerance.
  template <std::size_t N>
  Check& unit(const double (&values)[N], const char* field) noexcept {
    if (verdict_) return *this;
    double squared = 0;
    for (const double value : values) squared += value * value;
    if (std::abs(std::sqrt(squared) - 1.0) <= unit_tolerance) return *this;
    return that(false, finite(values) ? RejectReason::not_unit : RejectReason::not_finite, field);
  }
  Check& stamp(std::int64_t value, const char* field) noexcept {
    return that(value >= -latest_stamp && value <= latest_stamp, RejectReason::out_of_range, field);
  }

  const Verdict& verdict() const noexcept { return verdict_; }

 private:
  Verdict verdict_;
};

}  // namespace palpate::wire_parts
