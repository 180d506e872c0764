#pragma once
// Two PCs in one, by deploy/two_host_lab.sh. Skipped, with words, where the kernel makes no namespaces for the one who runs
// the tests.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "common/report/json_file.h"
#include "tests/system/shell.h"

namespace palpate::test {

namespace fs = std::filesystem;

class TwoPcs : public testing::Test {
 protected:
  void SetUp() override {
    const char* as_user = geteuid() == 0 ? "" : "--user --map-root-user ";
    const std::string attempt = fmt::format("unshare {}--net true 2>{}", as_user, quoted(folder / "why"));
    fs::create_directories(folder);
    if (std::system(attempt.c_str()) != 0) GTEST_SKIP() << "no network namespaces here: " << text("why");
  }
  ~TwoPcs() override { fs::remove_all(folder); }

  /// @return exit code of the lab
  int lab(const std::string& words) const {
    const std::string line = fmt::format("{} {} --bin-dir {} --out {} >{} 2>&1", quoted(LAB), words,
                                         quoted(BIN), quoted(folder / "out"), quoted(folder / "said"));
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string text(const std::string& name) const {
    std::ifstream file(folder / name);
    std::stringstream all;
    all << file.rdbuf();
    return all.str();
  }
  nlohmann::json summary(const std::string& pc) const {
    return read_json((folder / "out" / pc / "summary.json").string());
  }
  static std::string palpate(const std::string& scene, const std::string& words) {
    return fmt::format("{} run {} --headless {}", quoted(BIN "/palpate"),
                       quoted(fs::path(SCENES) / (scene + ".toml")), words);
  }

  fs::path folder = fs::temp_directory_path() / fmt::format("palpate_two_pcs_{}", getpid());
};

}  // namespace palpate::test
