#pragma once
// The one call of the TOML parser.

#include <string>
#include <string_view>

#include "common/scene/toml.h"

namespace palpate {

/// @param name  of the file in places and messages
/// @throws InputError with one complaint, at the first place where the text is no TOML
toml::table table_of_text(std::string_view text, const std::string& name);

}  // namespace palpate
