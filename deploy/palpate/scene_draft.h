#pragma once
// A scene file with comments, for a person to read and change.

#include <string>

#include "deploy/palpate/press_plan.h"

namespace palpate::deploy {

inline constexpr double step_safety = 0.9;  // [physics] safety of these scenes

/// The text of a scene that presses an image as planned.
/// @param file   of the volume, as the scene will name it
/// @param words  on where `keep` is from
std::string scene_draft(const std::string& file, const std::string& words, const ImageTissue& tissue,
                        const TouchPlace& place, const PressPlan& plan);

/// Writes it whole, or not at all. @throws InputError
void write_scene(const std::string& text, const std::string& path);

/// A basic string of TOML.
std::string in_quotes(const std::string& text);
/// A line of a comment cannot end before its end.
std::string in_comment(std::string text);

/// `volume` as a scene file at `scene` has to name it: from the folder of that where links allow, else in full.
std::string named_from(const std::string& volume, const std::string& scene);

}  // namespace palpate::deploy
