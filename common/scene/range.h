#pragma once
// The numbers that a key accepts, and how to say so to a person.

#include <limits>
#include <string>

namespace palpate {

struct Range {
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();
  bool without_lo = false;  // lo itself is not accepted

  bool contains(double value) const { return value <= hi && (without_lo ? value > lo : value >= lo); }
  /// "a number above 0", "a number from 1 to 5"
  std::string text() const;
};

inline constexpr Range any_number{};
inline constexpr Range positive{.lo = 0, .without_lo = true};
inline constexpr Range not_negative{.lo = 0};

/// How long anything may run [s]: eleven days. Whatever is asked of a scene or on a command line lies in it.
inline constexpr Range run_seconds{.lo = 0, .hi = 1e6, .without_lo = true};

}  // namespace palpate
