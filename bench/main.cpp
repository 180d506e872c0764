// palpate-bench: what `palpate bench` becomes.

#include <cstdio>
#include <exception>
#include <vector>

#include "bench/subcommands.h"
#include "common/error/error.h"
#include "common/process/command_line.h"

int main(int argc, char** argv) {
  using namespace palpate;
  std::vector<void (*)(CLI::App&, int&)> subcommands = {
      bench::add_kernel,   bench::add_error, bench::add_skin,    bench::add_skips, bench::add_stress,
      bench::add_outcomes, bench::add_shots, bench::add_contact, bench::add_cut,   bench::add_fem,
      bench::add_haptic,   bench::add_touch, bench::add_machine, bench::add_parts, bench::add_render,
      bench::add_team,     bench::add_wire};
#ifdef PALPATE_BENCH_PEERS
  subcommands.push_back(bench::add_peers);
#endif
  int exit_code = exit_ok;
  CLI::App app{"palpate bench: how fast, for how much error", "palpate bench"};
  add_version(app, "palpate-bench");
  app.require_subcommand(0, 1);  // none: said below, so that an unknown word is named
  for (const auto add : subcommands) add(app, exit_code);
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) throw InputError("give a subcommand; see palpate bench --help");
  } catch (const CLI::Success& asked_for_help) {
    return app.exit(asked_for_help);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "palpate bench: %s; see palpate bench --help\n", mistake_text(app, error).c_str());
    return exit_mistake;
  } catch (const InputError& error) {
    for (const auto& line : error.complaints()) std::fprintf(stderr, "palpate bench: %s\n", line.c_str());
    return exit_mistake;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "palpate bench: %s\n", error.what());
    return exit_failed;
  }
  return exit_code;
}
