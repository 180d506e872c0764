#pragma once
// What of the tissue CommandKind::reset brings back: by the command's name all of it, or as it was before the last stroke of a blade.

#include <string_view>

#include "common/message/node_messages.h"

namespace palpate {

inline constexpr std::string_view last_stroke = "stroke";

inline bool is_undo(const Command& command) noexcept {
  return command.kind == CommandKind::reset && std::string_view(command.name.data()) == last_stroke;
}

}  // namespace palpate
