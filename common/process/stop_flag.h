#pragma once
// SIGINT and SIGTERM as a flag that loops look at. The handler only sets it.

namespace palpate {

/// Installs the handlers; call once from main().
void install_stop_handlers() noexcept;

/// True after SIGINT, SIGTERM or request_stop().
bool stop_requested() noexcept;

/// As if a signal had come.
void request_stop() noexcept;

}  // namespace palpate
