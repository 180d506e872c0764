// palpate plot DIR

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "common/error/error.h"
#include "common/file/privacy.h"
#include "deploy/palpate/plotter.h"
#include "deploy/palpate/subcommands.h"

namespace palpate::deploy {

namespace {

std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> files;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
    if (entry.is_regular_file(ignored)) files.push_back(entry.path().string());
  return files;
}

}  // namespace

void add_plot(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("plot", "draw force, moment and energy of a session as pictures");
  auto folder = std::make_shared<std::string>();
  command->add_option("folder", *folder, "folder of the session: where its summary.json is")->required();
  command->callback([folder, &exit_code] {
    if (!std::filesystem::is_regular_file(std::filesystem::path(*folder) / "summary.json")) {
      throw InputError(fmt::format(
          "{}: has no summary.json; give the folder that palpate run or simulate wrote", *folder));
    }
    keep_as_private_as(files_in(*folder));
    const bool drawn = draw_plots(*folder);
    if (drawn) say_plots(*folder);
    exit_code = drawn ? exit_ok : exit_failed;
  });
}

}  // namespace palpate::deploy
