// palpate bench: becomes palpate-bench.

#include <fmt/format.h>

#include <utility>

#include "common/error/error.h"
#include "deploy/palpate/become_program.h"
#include "deploy/palpate/install_paths.h"
#include "deploy/palpate/subcommands.h"

namespace palpate::deploy {
namespace {

[[noreturn]] void become_bench(std::vector<std::string> arguments) {
  const std::string program = (bin_folder() / "palpate-bench").string();
  if (!is_program(program))
    throw InputError(fmt::format(
        "{} is missing; install the package libbenchmark-dev and build palpate with PALPATE_BENCH", program));
  become_program(program, std::move(arguments));
}

}  // namespace

void add_bench(CLI::App& app, int&) {
  auto* command =
      app.add_subcommand("bench", "measure: how fast, for how much error, how robust, against peers");
  command->set_help_flag("");
  command->prefix_command();
  command->callback([command] { become_bench(command->remaining()); });
}

}  // namespace palpate::deploy
