#include "deploy/palpate/film.h"

#include <fmt/format.h>

#include <cstdio>
#include <string>

#include "common/error/error.h"
#include "deploy/palpate/child.h"
#include "deploy/palpate/install_paths.h"

namespace palpate::deploy {
namespace fs = std::filesystem;

void require_film(const fs::path& film) {
  if (program_on_path("ffmpeg").empty())
    throw InputError(
        "--video: no ffmpeg is installed; install the package ffmpeg, or leave --video out and "
        "make a film of OUT/frames elsewhere");
  std::error_code unseen;
  if (fs::symlink_status(film, unseen).type() != fs::file_type::not_found)
    throw InputError(fmt::format("--video {}: lies there already; choose another name", film.string()));
  if (!fs::is_directory(fs::absolute(film).parent_path()))
    throw InputError(fmt::format("--video {}: no such folder; make it first", film.string()));
}

bool make_film(const fs::path& out, const nlohmann::json& summary, double rate_Hz, const fs::path& film) {
  if (summary.contains("render")) rate_Hz /= summary["render"].value("frames_every", 1.0);
  // An even number of rows and columns in four bits of colour: what players everywhere show.
  const Ending ending =
      Child(program_on_path("ffmpeg"),
            {"-nostdin", "-loglevel", "error", "-n", "-framerate", fmt::format("{:g}", rate_Hz), "-i",
             (out / "frames" / "frame_%05d.png").string(), "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt",
             "yuv420p", fs::absolute(film).string()})
          .wait();
  if (ending.clean() && fs::exists(film)) {
    std::printf("film     %s\n", film.c_str());
    return true;
  }
  std::error_code none;
  fs::remove(film, none);  // what there is of it
  std::fprintf(stderr, "palpate: ffmpeg %s, so there is no film; the pictures are in %s\n",
               ending.text().c_str(), (out / "frames").c_str());
  return false;
}

}  // namespace palpate::deploy
