// palpate export: the positions of a record as files that ParaView opens by a double click, and VTK reads.

#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "common/error/error.h"
#include "common/file/privacy.h"
#include "common/file/scratch_folder.h"
#include "common/process/checked_option.h"
#include "common/scene/record_spec.h"
#include "common/scene/scene.h"
#include "deploy/palpate/subcommands.h"
#include "deploy/palpate/viewers.h"
#include "physics_node/record/export_vtk.h"
#include "physics_node/record/session_record.h"

namespace palpate::deploy {
namespace {

namespace fs = std::filesystem;

struct ExportOptions {
  std::string record;
  std::string out;
  double rate_Hz = physics::VtkWish{}.rate_Hz;
  double limit_MB = 1e-6 * static_cast<double>(physics::VtkWish{}.most_bytes);
};

void say(const physics::VtkExport& done) {
  fmt::print("paraview {} ({} times, {:.0f} MB)\n", done.collection.string(), done.times,
             1e-6 * static_cast<double>(done.bytes));
}

int run_export(const ExportOptions& options) {
  const fs::path path =
      fs::is_directory(options.record) ? fs::path(options.record) / "record.h5" : fs::path(options.record);
  keep_as_private_as({path.string()});
  const physics::SessionRecord record(path.string());
  const ScratchFolder files;
  const auto laid_out = record.lay_out(files.path().string());
  physics::VtkWish wish;
  wish.folder = options.out.empty() ? path.parent_path() : fs::path(options.out);
  wish.rate_Hz = options.rate_Hz;
  wish.most_bytes = static_cast<std::uint64_t>(1e6 * options.limit_MB);
  const physics::VtkExport done = physics::export_vtk(path.string(), laid_out.scene, wish);
  if (done.collection.empty())
    throw InputError(path.string() +
                     ": holds no positions; write what = [\"positions\"] under [record] in the scene and run "
                     "it again, or palpate replay it with such a scene");
  if (done.thinned)
    fmt::print("a time every {:.3g} s, to keep to {:.0f} MB; --limit-MB allows more\n", done.every_s,
               options.limit_MB);
  say(done);
  return exit_ok;
}

}  // namespace

void export_for_viewers(const fs::path& out, const Scene& scene) {
  if (!scene.record->positions) return;
  try {
    const physics::VtkExport done = physics::export_vtk((out / "record.h5").string(), scene, {.folder = out});
    if (!done.collection.empty()) say(done);
  } catch (const std::exception& hindered) {
    fmt::print(stderr, "palpate: nothing for ParaView was written: {}; palpate export {} tries again\n",
               hindered.what(), out.string());
  }
}

void add_export(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("export", "the positions of a record as files for ParaView and VTK");
  auto options = std::make_shared<ExportOptions>();
  command->add_option("record", options->record, "record.h5 of a session, or its folder")->required();
  command->add_option("--out", options->out, "folder for record.pvd and vtk/ (default: beside the record)");
  command->add_option("--rate-Hz", options->rate_Hz, "times a second, at most those recorded")
      ->capture_default_str()
      ->check(number_in({.lo = 1e-3, .hi = 1e4}));
  command->add_option("--limit-MB", options->limit_MB, "fewer times are written where they would take more")
      ->capture_default_str()
      ->check(number_in({.lo = 1, .hi = 1e6}));
  command->callback([options, &exit_code] { exit_code = run_export(*options); });
}

}  // namespace palpate::deploy
