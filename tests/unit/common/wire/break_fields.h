#pragma once
// Breaks one promise of a sample at a time: as many samples as its fields have ways to be wrong.

#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "common/message/promise.h"

namespace palpate::test {

/// What was broken, and what must be said of it.
struct Breach {
  std::string field;
  RejectReason reason = RejectReason::other;
};

/// Whether all arrays of a message hold something, so that everything in it can be broken.
template <class M>
class LooksForEmpty {
 public:
  LooksForEmpty(const M& message, bool& full) : message_(message), full_(full) {}
  template <class Of, class Promise>
  void operator()(Field<Of>, Promise) {}
  template <class Of, class N, class Promise>
  void first(Field<Of>, Field<N> n, Promise) {
    full_ = full_ && n.of(message_) > 0;
  }
  template <class Of, class N, class S>
  void each(Field<Of>, Field<N> n, OfType<S>) {
    full_ = full_ && n.of(message_) > 0;
  }
  template <class Holds>
  void rule(const char*, RejectReason, Holds) {}

 private:
  const M& message_;
  bool& full_;
};

template <class Wire>
class BreakField {
 public:
  /// @param which  of all breaches, in order; it is counted down
  BreakField(Wire& wire, int& which, Breach& breach, std::string list = "")
      : wire_(wire), which_(which), breach_(breach), list_(std::move(list)) {}

  template <class Of, class Promise>
  void operator()(Field<Of> field, Promise promise) {
    name_ = field.name;
    spoil(field.of(wire_), promise);
  }
  /// The last one that counts.
  template <class Of, class N, class Promise>
  void first(Field<Of> field, Field<N> n, Promise promise) {
    name_ = field.name;
    if (is_done()) return;
    if (n.of(wire_) > 0) spoil(field.of(wire_)[n.of(wire_) - 1], promise);
  }
  template <class Of, class N, class S>
  void each(Field<Of> field, Field<N> n, OfType<S>) {
    if (is_done() || n.of(wire_) == 0) return;
    auto& last = field.of(wire_)[n.of(wire_) - 1];
    S::fields(BreakField<std::remove_reference_t<decltype(last)>>(last, which_, breach_,
                                                                  std::string(field.name) + "."));
  }
  template <class Holds>
  void rule(const char*, RejectReason, Holds) {}  // by hand, in malformed_test.cpp

 private:
  /// The breach is made; a count that it spoilt is no index any more.
  bool is_done() const { return which_ < 0; }
  bool is_next(RejectReason reason) {
    if (which_-- != 0) return false;
    breach_ = {list_ + name_, reason};
    return true;
  }
  template <class T, class V>
  void set(T& value, V wrong, RejectReason reason) {
    if (is_next(reason)) value = static_cast<T>(wrong);
  }

  template <class T>
  void spoil(T&, promise::Any) {}
  void spoil(std::uint32_t& value, promise::Below promise) {
    set(value, promise.end, RejectReason::unknown_id);
    set(value, 0xffffffffU, RejectReason::unknown_id);
  }
  void spoil(std::uint32_t& value, promise::Count promise) {
    set(value, promise.most + 1, RejectReason::count);
    set(value, 0xffffffffU, RejectReason::count);
  }
  void spoil(std::uint32_t& value, promise::FromOne) { set(value, 0, RejectReason::out_of_range); }
  void spoil(std::uint32_t& value, promise::Flag) { set(value, 2, RejectReason::out_of_range); }
  void spoil(std::uint32_t& value, promise::OneOf promise) { set(value, promise.n, promise.reason); }
  void spoil(std::int64_t& value, promise::Stamp) {
    set(value, latest_stamp + 1, RejectReason::out_of_range);
    set(value, std::numeric_limits<std::int64_t>::min(), RejectReason::out_of_range);
  }
  template <class T, std::size_t N>
  void spoil(T (&values)[N], promise::Within promise) {
    for (T& value : values) spoil(value, promise);
  }
  template <class T>
  void spoil(T& value, promise::Within promise) {
    set(value, std::numeric_limits<T>::quiet_NaN(), RejectReason::not_finite);
    set(value, -std::numeric_limits<T>::infinity(), RejectReason::not_finite);
    set(value, 1.01 * promise.limit, RejectReason::out_of_range);
    set(value, -1.01 * promise.limit, RejectReason::out_of_range);
  }
  template <class T>
  void spoil(T& value, promise::UpTo promise) {
    spoil(value, promise::Within{promise.limit});
    set(value, -std::numeric_limits<T>::denorm_min(), RejectReason::out_of_range);
  }
  void spoil(double& value, promise::AboveZero promise) {
    spoil(value, promise::UpTo{promise.limit});
    set(value, 0, RejectReason::out_of_range);
  }
  template <std::size_t N>
  void spoil(double (&values)[N], promise::Unit promise) {
    for (double& value : values)
      set(value, std::numeric_limits<double>::quiet_NaN(), RejectReason::not_finite);
    if (is_next(RejectReason::not_unit)) set_length(values, 1.002);
    if (is_next(RejectReason::not_unit)) set_length(values, 0.5);
    if (!promise.or_zero && is_next(RejectReason::not_unit)) set_length(values, 0);
  }
  template <std::size_t N>
  static void set_length(double (&values)[N], double length) {
    std::memset(values, 0, sizeof values);
    values[N - 1] = length;
  }
  template <std::size_t N>
  void spoil(std::uint8_t (&text)[N], promise::Text) {
    if (is_next(RejectReason::text)) std::memset(text, 'x', N);
  }

  Wire& wire_;
  int& which_;
  Breach& breach_;
  std::string list_;
  const char* name_ = "";
};

}  // namespace palpate::test
