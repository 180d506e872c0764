#include "deploy/palpate/out_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <regex>
#include <string>
#include <utility>
#include <vector>

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

/// Begins as palpate begins such a file, and is no link.
bool is_own(const fs::path& file, const std::string& beginning) {
  std::error_code error;
  if (fs::is_symlink(file, error) || !fs::is_regular_file(file, error)) return false;
  std::string found(beginning.size(), '\0');
  std::ifstream(file, std::ios::binary).read(found.data(), static_cast<std::streamsize>(found.size()));
  return found == beginning;
}

/// Traces and exports of an earlier run, which would lie beside the new results as if they were of them.
void remove_results(const fs::path& out) {
  static const std::regex trace("tool_.+\\.csv"),
      mesh("(body_.+_[0-9]{5,}|scenery_.+|tools_[0-9]{5,})\\.vtp");
  std::error_code error;
  if (is_own(out / "energy.csv", "t_s,kinetic_J,")) fs::remove(out / "energy.csv", error);
  const std::string xml = "<?xml version=\"1.0\"?>\n<VTKFile type=";
  if (is_own(out / "record.pvd", xml)) fs::remove(out / "record.pvd", error);
  const auto remove_named = [&](const fs::path& folder, const std::regex& name,
                                const std::string& beginning) {
    std::vector<fs::path> found;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
      if (std::regex_match(entry->path().filename().string(), name) && is_own(entry->path(), beginning))
        found.push_back(entry->path());
    for (const auto& file : found) fs::remove(file, error);
  };
  remove_named(out, trace, "t_s,x_m,y_m,z_m,fx_N,");
  remove_named(out / "vtk", mesh, xml);
}

/// What lies behind a link is somebody else's.
void refuse_link(const fs::path& folder) {
  std::error_code error;
  if (fs::is_symlink(folder, error))
    throw InputError(folder.string() + ": is a link; remove it, or give another folder with --out");
}

}  // namespace

fs::path default_out(const std::string& scene_path) { return fs::path("out") / fs::path(scene_path).stem(); }

HeldFolder::HeldFolder(const fs::path& folder)
    : descriptor_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  // Where a file system knows no locks, nobody is kept out.
  if (descriptor_ < 0 || flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  close(descriptor_);
  throw InputError(
      folder.string() +
      ": another palpate is writing to it; wait until it has ended, or give another folder with --out");
}

HeldFolder::~HeldFolder() {
  if (descriptor_ >= 0) close(descriptor_);
}

HeldFolder prepare_out(const fs::path& out) {
  std::error_code error;
  for (const char* name : {"parts", "frames", "vtk"}) refuse_link(out / name);
  fs::create_directories(out / "parts", error);
  if (error || access(out.c_str(), W_OK | X_OK) != 0 || access((out / "parts").c_str(), W_OK | X_OK) != 0) {
    throw InputError(fmt::format("{}: cannot be written to ({}); give another folder with --out",
                                 out.string(), error ? error.message() : "no right to write"));
  }
  HeldFolder held(out);
  for (const char* name : {"summary.json", "force.png", "energy.png"}) fs::remove(out / name, error);
  for (const char* name : {"physics.json", "haptic.json", "render.json"})
    fs::remove(out / "parts" / name, error);
  remove_pictures(out / "frames");
  remove_results(out);
  return held;
}

}  // namespace palpate::deploy
