// palpate import: becomes palpate-import.

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "common/error/error.h"
#include "deploy/palpate/install_paths.h"
#include "deploy/palpate/subcommands.h"

namespace palpate::deploy {
namespace {

[[noreturn]] void become_importer(std::vector<std::string> arguments) {
  std::string program = (bin_folder() / "palpate-import").string();
  if (!is_program(program))
    throw std::runtime_error(fmt::format("{} is missing; build or install the importer", program));
  std::vector<char*> argv = {program.data()};
  for (auto& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  throw std::runtime_error(fmt::format("{} cannot be started: {}", program, std::strerror(errno)));
}

}  // namespace

void add_import(CLI::App& app, int&) {
  auto* command = app.add_subcommand(
      "import", "turn an image (DICOM, NIfTI, NRRD, MHA, .inv3, .inr, raw) or a made phantom into a volume");
  command->set_help_flag("");
  command->prefix_command();
  command->callback([command] { become_importer(command->remaining()); });
}

}  // namespace palpate::deploy
