#pragma once
// A film of the pictures of a run, made by ffmpeg where it is installed.

#include <filesystem>
#include <nlohmann/json.hpp>

namespace palpate::deploy {

/// Before anything is started: can this film be made?
/// @throws InputError, one line: no ffmpeg, no such folder, something lies there already
void require_film(const std::filesystem::path& film);

/// Makes it of OUT/frames/frame_00001.png and so on; what ffmpeg complains of goes to stderr.
/// @param out   folder of a run without a window
/// @param summary  of the run: says how many pictures were due for each that lies there
/// @param rate_Hz  pictures a simulated second that were due, > 0: the film runs as simulated time does
/// @return true if it is there
bool make_film(const std::filesystem::path& out, const nlohmann::json& summary, double rate_Hz,
               const std::filesystem::path& film);

}  // namespace palpate::deploy
