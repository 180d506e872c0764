#pragma once
// The subcommands of `palpate`, one per file. Each adds itself to the command line; its callback does the work and
// leaves the exit code, or throws InputError for a person's mistake.

#include <CLI/CLI.hpp>

namespace palpate::deploy {

void add_bench(CLI::App& app, int& exit_code);
void add_run(CLI::App& app, int& exit_code);
void add_simulate(CLI::App& app, int& exit_code);
void add_export(CLI::App& app, int& exit_code);
void add_import(CLI::App& app, int& exit_code);
void add_new(CLI::App& app, int& exit_code);
void add_view(CLI::App& app, int& exit_code);
void add_info(CLI::App& app, int& exit_code);
void add_plot(CLI::App& app, int& exit_code);
void add_doctor(CLI::App& app, int& exit_code);
void add_reset(CLI::App& app, int& exit_code);
void add_undo(CLI::App& app, int& exit_code);
void add_replay(CLI::App& app, int& exit_code);

}  // namespace palpate::deploy
