#include <algorithm>
#include <fstream>
#include <sstream>

#include "tests/house/house_rules.h"

namespace palpate::house {
namespace fs = std::filesystem;
namespace {

bool is_ignored(const std::string& path) {
  for (const auto* top : {".git", "build", "out", "data"})
    if (path == top || path.starts_with(std::string(top) + "/")) return true;
  return path.find("__pycache__") != path.npos;
}

SourceFile read(const fs::path& root, const std::string& path) {
  SourceFile file;
  file.path = path;
  std::ifstream stream(root / path, std::ios::binary);
  std::ostringstream all;
  all << stream.rdbuf();
  const auto text = all.str();
  file.bytes = text.size();
  file.is_text = text.find('\0') == text.npos;
  std::istringstream lines(file.is_text ? text : "");
  for (std::string line; std::getline(lines, line);) file.lines.push_back(line);
  return file;
}

void append(std::vector<std::string>& all, std::vector<std::string> more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

std::vector<SourceFile> read_house(const fs::path& root) {
  std::vector<std::string> paths;
  for (auto entry = fs::recursive_directory_iterator(root); entry != fs::recursive_directory_iterator();
       ++entry) {
    const auto path = entry->path().lexically_relative(root).generic_string();
    if (is_ignored(path)) {
      if (entry->is_directory()) entry.disable_recursion_pending();
    } else if (entry->is_regular_file()) {
      paths.push_back(path);
    }
  }
  std::sort(paths.begin(), paths.end());
  std::vector<SourceFile> files;
  for (const auto& path : paths) files.push_back(read(root, path));
  return files;
}

std::vector<std::string> house_breaches(const fs::path& root) {
  std::vector<std::string> breaches;
  const auto files = read_house(root);
  for (const auto& file : files) {
    append(breaches, include_breaches(file));
    append(breaches, text_breaches(file));
    append(breaches, data_breaches(file));
    append(breaches, seam_breaches(file));
  }
  append(breaches, page_breaches(files));
  append(breaches, link_breaches(files));
  append(breaches, mirror_breaches(files));
  return breaches;
}

}  // namespace palpate::house
