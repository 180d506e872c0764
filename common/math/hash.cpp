#include "common/math/hash.h"

#include <fmt/format.h>

namespace palpate {

std::string hex_of(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

}  // namespace palpate
