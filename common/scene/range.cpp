#include "common/scene/range.h"

#include <fmt/format.h>

#include <cmath>

namespace palpate {

std::string Range::text() const {
  if (std::isinf(lo) && std::isinf(hi)) return "a finite number";
  if (std::isinf(lo)) return fmt::format("a number, at most {}", hi);
  if (std::isinf(hi))
    return without_lo ? fmt::format("a number above {}", lo) : fmt::format("a number, {} or more", lo);
  return without_lo ? fmt::format("a number above {} and at most {}", lo, hi)
                    : fmt::format("a number from {} to {}", lo, hi);
}

}  // namespace palpate
