#pragma once
// Where the parts of palpate are, seen from the running program: BIN/palpate, BIN/palpate-physics, ...,
// BIN/../share/palpate. The build tree has the same shape as an installation.

#include <filesystem>
#include <string>

namespace palpate::deploy {

/// Folder of the running program.
std::filesystem::path bin_folder();

/// BIN/../share/palpate
std::filesystem::path share_folder();

/// True if `path` is a program that may be started.
bool is_program(const std::filesystem::path& path);

/// The program of this name in a folder of PATH; empty: there is none.
std::filesystem::path program_on_path(const std::string& name);

}  // namespace palpate::deploy
