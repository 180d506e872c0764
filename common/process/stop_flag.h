#pragma once
// SIGINT, SIGTERM, SIGHUP and SIGPWR as a flag that loops look at. The handler only sets it.

#include <string>

namespace palpate {

/// Installs the handlers, and has SIGPIPE, SIGXFSZ and SIGTTOU ignored; call once from main().
void install_stop_handlers() noexcept;

/// True after one of these signals or request_stop().
bool stop_requested() noexcept;

/// Name of the program that sent the last of these signals; empty if none did, or if it has gone.
std::string stopped_by();

/// As if a signal had come.
void request_stop() noexcept;

}  // namespace palpate
