#pragma once
// Visits the fields of a sample (common/message/promise.h) and keeps the first promise that is broken. For common/wire only.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "common/message/promise.h"
#include "common/wire/convert.h"

namespace palpate {

namespace wire_parts {

inline bool finite(double value) noexcept { return std::isfinite(value); }
inline bool finite(float value) noexcept { return std::isfinite(value); }
/// All numbers of the first `n` elements of an array of numbers or of arrays.
template <class T, std::size_t N>
bool finite(const T (&values)[N], std::size_t n = N) noexcept {
  return std::all_of(values, values + std::min(n, N), [](const auto& value) { return finite(value); });
}

/// No number is larger than `limit`. False if anything is not finite.
inline bool is_within(double value, double limit) noexcept { return std::abs(value) <= limit; }
template <class T, std::size_t N>
bool is_within(const T (&values)[N], double limit, std::size_t n = N) noexcept {
  return std::all_of(values, values + std::min(n, N),
                     [limit](const auto& value) { return is_within(value, limit); });
}

/// Of numbers in arrays in arrays.
template <class T>
using Number = std::remove_all_extents_t<T>;

}  // namespace wire_parts

template <class Wire>
class JudgeFields {
 public:
  /// @param list  which field of another message these are elements of
  explicit JudgeFields(const Wire& wire, const char* list = "") noexcept : wire_(wire), list_(list) {}

  template <class Of, class Promise>
  void operator()(Field<Of> field, Promise promise) noexcept {
    if (!verdict_) judge(field.name, field.of(wire_), promise);
  }
  template <class Of, class N, class Promise>
  void first(Field<Of> field, Field<N> n, Promise promise) noexcept {
    if (!verdict_) judge(field.name, field.of(wire_), promise, n.of(wire_));
  }
  template <class Of, class N, class S>
  void each(Field<Of> field, Field<N> n, OfType<S>) noexcept {
    if (verdict_) return;
    const auto& elements = field.of(wire_);
    const std::size_t most = std::min<std::size_t>(n.of(wire_), std::size(elements));
    for (std::size_t i = 0; i < most && !verdict_; ++i) {
      JudgeFields<std::remove_cvref_t<decltype(elements[0])>> inner(elements[i], field.name);
      S::fields(inner);
      verdict_ = inner.verdict();
    }
  }
  template <class Holds>
  void rule(const char* name, RejectReason reason, Holds holds) noexcept {
    if (!verdict_) that(holds(wire_), reason, name);
  }

  const Verdict& verdict() const noexcept { return verdict_; }

 private:
  void that(bool kept, RejectReason reason, const char* field) noexcept {
    if (!kept) verdict_ = Broken{reason, field, list_};
  }

  template <class T>
  void judge(const char*, const T&, promise::Any, std::size_t = 0) noexcept {
    static_assert(!std::is_floating_point_v<wire_parts::Number<T>>,
                  "a limit for what may be infinite or none");
  }
  void judge(const char* name, std::uint32_t value, promise::Below promise) noexcept {
    that(value < promise.end, RejectReason::unknown_id, name);
  }
  void judge(const char* name, std::uint32_t value, promise::Count promise) noexcept {
    that(value <= promise.most, RejectReason::count, name);
  }
  void judge(const char* name, std::uint32_t value, promise::FromOne) noexcept {
    that(value > 0, RejectReason::out_of_range, name);
  }
  void judge(const char* name, std::uint32_t value, promise::Flag) noexcept {
    that(value <= 1, RejectReason::out_of_range, name);
  }
  void judge(const char* name, std::uint32_t value, promise::OneOf promise) noexcept {
    that(value < promise.n, promise.reason, name);
  }
  void judge(const char* name, std::int64_t value, promise::Stamp) noexcept {
    that(value >= -latest_stamp && value <= latest_stamp, RejectReason::out_of_range, name);
  }
  template <class T>
  void judge(const char* name, const T& value, promise::Within promise) noexcept {
    if (!wire_parts::is_within(value, promise.limit))
      that(false, wire_parts::finite(value) ? RejectReason::out_of_range : RejectReason::not_finite, name);
  }
  template <class T, std::size_t N>
  void judge(const char* name, const T (&values)[N], promise::Within promise, std::size_t n) noexcept {
    if (!wire_parts::is_within(values, promise.limit, n))
      that(false, wire_parts::finite(values, n) ? RejectReason::out_of_range : RejectReason::not_finite,
           name);
  }
  void judge(const char* name, double value, promise::UpTo promise) noexcept {
    judge(name, value, promise::Within{promise.limit});
    if (!verdict_) that(!(value < 0), RejectReason::out_of_range, name);
  }
  void judge(const char* name, double value, promise::AboveZero promise) noexcept {
    judge(name, value, promise::Within{promise.limit});
    if (!verdict_) that(value > 0, RejectReason::out_of_range, name);
  }
  template <std::size_t N>
  void judge(const char* name, const double (&values)[N], promise::Unit promise) noexcept {
    constexpr double tolerance = 1e-3;
    double squared = 0;
    for (const double value : values) squared += value * value;
    if (std::abs(std::sqrt(squared) - 1.0) <= tolerance || (promise.or_zero && is_zero(values))) return;
    that(false, wire_parts::finite(values) ? RejectReason::not_unit : RejectReason::not_finite, name);
  }
  template <std::size_t N>
  void judge(const char* name, const std::uint8_t (&text)[N], promise::Text) noexcept {
    that(std::memchr(text, 0, N) != nullptr, RejectReason::text, name);
  }
  template <std::size_t N>
  static bool is_zero(const double (&values)[N]) noexcept {
    return std::all_of(values, values + N, [](double value) { return value == 0; });
  }

  const Wire& wire_;
  const char* list_;
  Verdict verdict_;
};

}  // namespace palpate
