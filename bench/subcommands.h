#pragma once
// The subcommands of `palpate bench`, one per folder. Each adds itself to the command line; its callback does the work
// and leaves the exit code, or throws InputError for a person's mistake.

#include <CLI/CLI.hpp>

namespace palpate::bench {

void add_kernel(CLI::App& app, int& exit_code);
void add_contact(CLI::App& app, int& exit_code);
void add_cut(CLI::App& app, int& exit_code);
void add_error(CLI::App& app, int& exit_code);
void add_fem(CLI::App& app, int& exit_code);
void add_haptic(CLI::App& app, int& exit_code);
void add_machine(CLI::App& app, int& exit_code);
void add_outcomes(CLI::App& app, int& exit_code);
void add_parts(CLI::App& app, int& exit_code);
void add_render(CLI::App& app, int& exit_code);
void add_shots(CLI::App& app, int& exit_code);
void add_skin(CLI::App& app, int& exit_code);
void add_skips(CLI::App& app, int& exit_code);
void add_stress(CLI::App& app, int& exit_code);
void add_team(CLI::App& app, int& exit_code);
void add_touch(CLI::App& app, int& exit_code);
void add_wire(CLI::App& app, int& exit_code);
void add_peers(CLI::App& app, int& exit_code);  // only where PALPATE_BENCH_PEERS is defined

}  // namespace palpate::bench
