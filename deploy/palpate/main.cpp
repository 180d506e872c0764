// palpate: the one command that a person types.

#include <array>
#include <cstdio>
#include <exception>
#include <string>

#include "common/error/error.h"
#include "common/process/command_line.h"
#include "deploy/palpate/subcommands.h"

namespace {

/// "palpate run" once a command was understood, else "palpate".
std::string asked_of(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  return commands.empty() ? "palpate" : "palpate " + commands.front()->get_name();
}

}  // namespace

int main(int argc, char** argv) {
  using namespace palpate;
  constexpr std::array subcommands = {
      deploy::add_run,   deploy::add_simulate, deploy::add_replay, deploy::add_import, deploy::add_new,
      deploy::add_view,  deploy::add_info,     deploy::add_plot,   deploy::add_doctor, deploy::add_bench,
      deploy::add_reset, deploy::add_undo,     deploy::add_export};
  int exit_code = exit_ok;
  CLI::App app{"palpate: feel soft tissue through a haptic device"};
  add_version(app, "palpate");
  app.require_subcommand(0, 1);  // none: said below, so that an unknown word is named
  for (const auto add : subcommands) add(app, exit_code);
  try {
    app.parse(argc, argv);
    if (app.get_subcommands().empty()) throw InputError("give a subcommand; see palpate --help");
  } catch (const CLI::Success& asked_for_help) {
    return app.exit(asked_for_help);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "palpate: %s; see %s --help\n", mistake_text(app, error).c_str(),
                 asked_of(app).c_str());
    return exit_mistake;
  } catch (const InputError& error) {
    for (const auto& line : error.complaints()) std::fprintf(stderr, "palpate: %s\n", line.c_str());
    return exit_mistake;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "palpate: %s\n", error.what());
    return exit_failed;
  }
  return exit_code;
}
