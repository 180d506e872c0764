#pragma once
// Lines for a person, on stderr, from slow threads only:
//
//     12.345 physics warn  step 0.62 ms over 0.50 ms
//
// seconds since the program started, program, level, text. info: milestones; warn: look; error: it stops.

#include <fmt/format.h>

#include <string_view>
#include <utility>

namespace palpate {

/// Name of the program in the lines that follow; once, before any thread logs.
void set_log_name(std::string_view name);

enum class LogLevel { info, warn, error };
void log_line(LogLevel level, std::string_view text);

template <class... Args>
void log_info(fmt::format_string<Args...> form, Args&&... args) {
  log_line(LogLevel::info, fmt::format(form, std::forward<Args>(args)...));
}
template <class... Args>
void log_warn(fmt::format_string<Args...> form, Args&&... args) {
  log_line(LogLevel::warn, fmt::format(form, std::forward<Args>(args)...));
}
template <class... Args>
void log_error(fmt::format_string<Args...> form, Args&&... args) {
  log_line(LogLevel::error, fmt::format(form, std::forward<Args>(args)...));
}

}  // namespace palpate
