#pragma once
// What `palpate info` says of the files of palpate, as text for a person. All throw InputError for a file that is not
// what its name says.

#include <string>

#include "common/scene/scene.h"

namespace palpate::deploy {

std::string info_scene(const std::string& path);   // a scene (.toml)
/// What a person should know before the scene runs, one line each; empty: nothing. Builds the bodies, and says what hinders that,
/// such as an image that has not been imported yet.
std::string remarks_text(const Scene& scene);
std::string info_volume(const std::string& path);  // an imported volume (.h5)
std::string info_record(const std::string& path);  // any other HDF5 file: its datasets

/// True for an HDF5 file that says it is a volume. @throws InputError if it cannot be opened as HDF5
bool is_volume(const std::string& path);

}  // namespace palpate::deploy
