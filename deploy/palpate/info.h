#pragma once
// What `palpate info` says of the files of palpate, as text for a person. All throw InputError for a file that is not
// what its name says.

#include <string>

namespace palpate::deploy {

/// A scene (.toml), with what a person should know before it runs. Builds its bodies as physics would, and throws what
/// hinders that, such as an image that has not been imported yet.
std::string info_scene(const std::string& path);
std::string info_volume(const std::string& path);   // an imported volume (.h5)
std::string info_mesh(const std::string& path);     // tetrahedra, imported (.h5)
std::string info_surface(const std::string& path);  // a closed surface, imported (.h5)
std::string info_record(const std::string& path);   // any other HDF5 file: its datasets

/// True for an HDF5 file that says it is a volume. @throws InputError if it cannot be opened as HDF5
bool is_volume(const std::string& path);

}  // namespace palpate::deploy
