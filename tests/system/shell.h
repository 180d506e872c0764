#pragma once
// Words for a shell: the clone, and the folder for temporary files, may lie at a path with a space in it.

#include <filesystem>
#include <string>

namespace palpate::test {

/// One word, whatever is in it.
inline std::string quoted(const std::string& word) {
  std::string out = "'";
  for (const char letter : word) out += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
  return out + "'";
}
inline std::string quoted(const std::filesystem::path& path) { return quoted(path.string()); }
inline std::string quoted(const char* word) { return quoted(std::string(word)); }

}  // namespace palpate::test
