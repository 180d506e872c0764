#pragma once
// Visits the fields of a message (common/message/promise.h) and copies them from its wire form or to it. For common/wire only.

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "common/message/promise.h"

namespace palpate {

template <class From, class To>
class CopyFields {
 public:
  CopyFields(const From& from, To& to) noexcept : from_(from), to_(to) {}

  template <class Of, class Promise>
  void operator()(Field<Of> field, Promise) const noexcept {
    copy(field.of(from_), field.of(to_));
  }
  /// Elements beyond the first n keep what they held.
  template <class Of, class N, class Promise>
  void first(Field<Of> field, Field<N> n, Promise) const noexcept {
    copy(field.of(from_), field.of(to_), n.of(from_));
  }
  template <class Of, class N, class S>
  void each(Field<Of> field, Field<N> n, OfType<S>) const noexcept {
    const auto& from = field.of(from_);
    auto& to = field.of(to_);
    const std::size_t most = std::min<std::size_t>(n.of(from_), std::min(std::size(from), std::size(to)));
    for (std::size_t i = 0; i < most; ++i)
      S::fields(CopyFields<Element<decltype(from)>, Element<decltype(to)>>(from[i], to[i]));
  }
  template <class Holds>
  void rule(const char*, RejectReason, Holds) const noexcept {}

 private:
  template <class Array>
  using Element = std::remove_cvref_t<decltype(std::declval<Array>()[0])>;

  /// Numbers; an enumeration is one on the wire.
  template <class A, class B>
  static void copy(const A& from, B& to) noexcept {
    if constexpr (std::is_enum_v<A> || std::is_enum_v<B>) {
      static_assert(sizeof(A) == sizeof(B));
      to = static_cast<B>(from);
    } else if constexpr (std::is_arithmetic_v<A>) {
      static_assert(std::is_same_v<A, B>, "the same type in the IDL and in the message");
      to = from;
    } else {
      copy(from, to, SIZE_MAX);
    }
  }
  /// The first `n` elements between arrays of one shape, never beyond their end.
  template <class A, class B>
  static void copy(const A& from, B& to, std::size_t n) noexcept {
    static_assert(std::is_trivially_copyable_v<A> && std::is_trivially_copyable_v<B>);
    static_assert(sizeof(A) == sizeof(B), "arrays of the same shape");
    constexpr std::size_t element = sizeof(from[0]);
    static_assert(element == sizeof(to[0]), "arrays of the same shape");
    std::memcpy(&to, &from, std::min(n, sizeof(A) / element) * element);
  }

  const From& from_;
  To& to_;
};

}  // namespace palpate
