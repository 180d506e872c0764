#pragma once
// The folder that a session leaves its results in.

#include <filesystem>
#include <string>

namespace palpate::deploy {

/// out/<name of the scene file>
std::filesystem::path default_out(const std::string& scene_path);

/// Makes the folder, makes sure that it may be written to, and removes what an earlier session left there (summary,
/// plots, its own pictures in frames/, parts/; nothing else is touched).
/// @throws InputError naming the folder
void prepare_out(const std::filesystem::path& out);

}  // namespace palpate::deploy
