#pragma once
// What a field of a message may hold. fields() of each message (messages.h) names its members once, each with its promise:
//
//   visit(field, promise)             a number, or every number of an array
//   visit.first(field, n, promise)    of an array only the first n elements
//   visit.each(field, n, of_type<S>)  an array of structs S, of which the first n count
//   visit.rule(name, reason, holds)   between fields; asked only where all before it is kept
//
// A visitor judges, copies, makes samples or breaks them. It looks at a message or at what the IDL makes of it: both call their
// members the same.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "common/message/limits.h"

namespace palpate {

template <class Of>
struct Field {
  const char* name;  // as the IDL calls it
  Of of;             // the member of a message or of its wire form
};
template <class Of>
Field(const char*, Of) -> Field<Of>;
#define PALPATE_FIELD(member)                                   \
  ::palpate::Field {                                            \
#member, [](auto& m) noexcept -> auto& { return m.member; } \
  }

template <class S>
struct OfType {
  using type = S;
};
template <class S>
inline constexpr OfType<S> of_type{};

namespace promise {

struct Any {};  // whatever its type holds; of no floating-point number
struct Below {  // an index
  std::uint32_t end;
};
struct Count {  // of elements, or of what is bounded like them
  std::uint32_t most;
};
struct FromOne {};
struct Flag {};  // 0 or 1
struct OneOf {   // an enumeration
  std::uint32_t n;
  RejectReason reason;
};
struct Stamp {};  // differences of two may be taken
struct Within {   // finite, either side of zero
  double limit;
};
struct UpTo {  // finite, from 0
  double limit;
};
struct AboveZero {  // finite
  double limit;
};
struct Unit {  // length one within 1e-3
  bool or_zero;
};
struct Text {};  // ends within its array

inline constexpr Any any{};
inline constexpr FromOne from_one{};
inline constexpr Flag flag{};
inline constexpr Stamp stamp{};
inline constexpr Unit unit{false}, unit_or_zero{true};
inline constexpr Text text{};
constexpr Below below(std::uint32_t end) noexcept { return {end}; }
constexpr Count count(std::uint32_t most) noexcept { return {most}; }
constexpr OneOf one_of(std::uint32_t n, RejectReason reason) noexcept { return {n, reason}; }
constexpr Within within(double limit) noexcept { return {limit}; }
constexpr UpTo up_to(double limit) noexcept { return {limit}; }
constexpr AboveZero above_zero(double limit) noexcept { return {limit}; }

// For rules. Whatever the 32-bit sums and products would do.

/// `n` things from `first` on lie within `total`.
constexpr bool ends_by(std::uint64_t first, std::uint64_t n, std::uint64_t total) noexcept {
  return first + n <= total;
}
/// `n` things find room in so many parts of `each`.
constexpr bool fits(std::uint64_t n, std::uint64_t parts, std::uint64_t each) noexcept {
  return n <= parts * each;
}
template <class Array, class Holds>
constexpr bool all_of_first(const Array& array, std::size_t n, Holds holds) noexcept {
  return std::all_of(std::begin(array), std::begin(array) + std::min(n, std::size(array)), holds);
}
template <class Array>
constexpr bool all_below(const Array& array, std::uint32_t end) noexcept {
  return std::all_of(std::begin(array), std::end(array), [end](std::uint32_t value) { return value < end; });
}
template <class Array, class Key>
constexpr bool is_growing(const Array& array, std::size_t n, Key key) noexcept {
  for (std::size_t i = 1; i < std::min(n, std::size(array)); ++i)
    if (key(array[i]) <= key(array[i - 1])) return false;
  return true;
}

}  // namespace promise
}  // namespace palpate
