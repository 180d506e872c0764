#include "deploy/palpate/out_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include "common/error/error.h"

namespace palpate::deploy {
namespace fs = std::filesystem;

namespace {

void remove_pictures(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.is_regular_file(error) && entry.path().extension() == ".png") fs::remove(entry.path(), error);
  }
}

}  // namespace

fs::path default_out(const std::string& scene_path) { return fs::path("out") / fs::path(scene_path).stem(); }

void prepare_out(const fs::path& out) {
  std::error_code error;
  fs::create_directories(out / "parts", error);
  if (error || access(out.c_str(), W_OK | X_OK) != 0 || access((out / "parts").c_str(), W_OK | X_OK) != 0) {
    throw InputError(fmt::format("{}: cannot be written to ({}); give another folder with --out",
                                 out.string(), error ? error.message() : "no right to write"));
  }
  for (const char* name : {"summary.json", "force.png", "energy.png"}) fs::remove(out / name, error);
  for (const char* name : {"physics.json", "haptic.json", "render.json"})
    fs::remove(out / "parts" / name, error);
  remove_pictures(out / "frames");
}

}  // namespace palpate::deploy
