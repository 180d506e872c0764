#pragma once
// What a process publishes about itself in its DDS domain before any sample: its role, its
// version, its scene. Travels as text in the participant's user data, which every version can read.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace palpate {

struct Identity {
  std::string role;  // physics, haptic, render, supervisor; empty: says nothing and is not compared
  std::uint32_t wire = 0;
  std::string commit;
  std::string scene;           // name of the scene file without folder and ending
  std::uint64_t checksum = 0;  // Scene::checksum
  std::string host;
  std::uint32_t pid = 0;
};

/// This process, in this build, on this machine.
Identity own_identity(const std::string& role, const std::string& scene_path, std::uint64_t checksum);

std::string to_text(const Identity& identity);

/// @return nothing if the text is not of palpate or breaks its form; it may be anything that a stranger sent
std::optional<Identity> identity_from(std::string_view text);

/// What a person should know if `other` does not fit `own`: one line that says what would be right; empty if it fits.
std::string difference(const Identity& own, const Identity& other);

}  // namespace palpate
