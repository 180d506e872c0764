#pragma once
// What every command line of palpate shares: --version, and mistakes in words that say what was probably meant.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace palpate {

/// "palpate-physics 0.1.0 (commit 0123456789)"
std::string version_line(const std::string& program);

/// Adds --version.
void add_version(CLI::App& app, const std::string& program);

/// One of these words, or a complaint that names the one that was probably meant.
CLI::Validator one_of(const std::vector<std::string>& words);

/// What is wrong with what was typed, in one line: an unknown command or option with the one that it looks like.
std::string mistake_text(const CLI::App& app, const CLI::ParseError& error);

}  // namespace palpate
