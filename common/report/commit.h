#pragma once
// Which commit this program was built from, so that every figure can name it.

#include <string>

namespace palpate {

/// Ten or more hexadecimal digits, with "-dirty" after changes that were not committed; "unknown" outside a checkout.
std::string commit();

/// Of the release, e.g. "0.1.0".
std::string version();

}  // namespace palpate
