// palpate import: becomes palpate-import.

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "common/error/error.h"
#include "deploy/palpate/become_program.h"
#include "deploy/palpate/install_paths.h"
#include "deploy/palpate/subcommands.h"

namespace palpate::deploy {
namespace {

[[noreturn]] void become_importer(std::vector<std::string> arguments) {
  const std::string program = (bin_folder() / "palpate-import").string();
  if (!is_program(program))
    throw std::runtime_error(fmt::format("{} is missing; build or install the importer", program));
  become_program(program, std::move(arguments));
}

}  // namespace

void add_import(CLI::App& app, int&) {
  auto* command = app.add_subcommand("import",
                                     "turn an image (DICOM, NIfTI, NRRD, MHA, .inv3, .inr, raw), a mesh or a "
                                     "made phantom into a volume or a mesh");
  command->set_help_flag("");
  command->prefix_command();
  command->callback([command] { become_importer(command->remaining()); });
}

}  // namespace palpate::deploy
