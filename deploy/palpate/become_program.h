#pragma once
// A subcommand that is a program of its own: this process becomes it.

#include <filesystem>
#include <string>
#include <vector>

namespace palpate::deploy {

/// Replaces this process by `program` with these arguments. @throws std::runtime_error if it cannot be started
[[noreturn]] void become_program(const std::filesystem::path& program, std::vector<std::string> arguments);

}  // namespace palpate::deploy
