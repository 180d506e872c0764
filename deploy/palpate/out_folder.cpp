#include "deploy/palpate/out_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include "common/error/error.h"
#include "render_node/image/own_picture.h"

namespace palpate::deploy {
namespace fs = std::filesystem;

namespace {

void remove_pictures(const fs::path& folder) {
  std::error_code error;
  for (const auto& picture : render::own_pictures(folder))
    fs::remove(folder / render::frame_name(picture.number), error);
}

/// What lies behind a link is somebody else's.
void refuse_link(const fs::path& folder) {
  std::error_code error;
  if (fs::is_symlink(folder, error))
    throw InputError(folder.string() + ": is a link; remove it, or give another folder with --out");
}

}  // namespace

fs::path default_out(const std::string& scene_path) { return fs::path("out") / fs::path(scene_path).stem(); }

void prepare_out(const fs::path& out) {
  std::error_code error;
  for (const char* name : {"parts", "frames", "vtk"}) refuse_link(out / name);
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
