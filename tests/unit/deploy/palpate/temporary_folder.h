#pragma once
// A folder that goes when the test goes.

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace palpate::test {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }
  void write(const std::string& name, const std::string& text) const { std::ofstream(path_ / name) << text; }

 private:
  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("palpate_unit_" + std::to_string(getpid()));
};

}  // namespace palpate::test
