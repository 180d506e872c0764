#pragma once
// The rules of the house that a machine can check: who includes whom, which room has which foreign header, how long
// a file may be, and what may never be in one. docs/architecture.md says why.

#include <filesystem>
#include <string>
#include <vector>

namespace palpate::house {

/// One file of the tree.
struct SourceFile {
  std::string path;                // from the root, with "/"
  std::vector<std::string> lines;  // empty if it is no text
  bool is_text = true;
  std::uintmax_t bytes = 0;
};

/// All files below `root` but what git ignores at the top (build, out, data) and git's own.
std::vector<SourceFile> read_house(const std::filesystem::path& root);

/// Each returns one line a breach: "file:line: what; what would be right".
std::vector<std::string> include_breaches(const SourceFile& file);  // directions and doors
std::vector<std::string> text_breaches(const SourceFile& file);     // sizes, words, paths, flags
std::vector<std::string> data_breaches(const SourceFile& file);     // data and binaries
std::vector<std::string> seam_breaches(const SourceFile& file);     // lattices and interfaces of physics_node

/// The same of pages that list what stands in other files (docs/reference, docs/contributing.md), for the whole house.
std::vector<std::string> page_breaches(const std::vector<SourceFile>& files);
std::vector<std::string> link_breaches(const std::vector<SourceFile>& files);  // from page to page

/// The same of rooms without unit tests, in a house that has any.
std::vector<std::string> mirror_breaches(const std::vector<SourceFile>& files);

/// All of them, for all files.
std::vector<std::string> house_breaches(const std::filesystem::path& root);

}  // namespace palpate::house
