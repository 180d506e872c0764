#include "common/report/json_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "common/error/error.h"
#include "common/file/new_file.h"

namespace palpate {

void write_json(const std::string& path, const nlohmann::json& value) {
  const std::string beside = fmt::format("{}.{}.part", path, getpid());
  const std::string text = value.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  std::FILE* file = open_new(beside);
  if (file == nullptr) {
    throw InputError(fmt::format("{}: cannot be written ({}); give a folder that you may write to", path,
                                 std::strerror(errno)));
  }
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const bool closed = std::fclose(file) == 0;
  if (!written || !closed || std::rename(beside.c_str(), path.c_str()) != 0) {
    const int why = errno;
    std::remove(beside.c_str());
    throw std::runtime_error(
        fmt::format("{}: could not be completed ({}); make room on the disk", path, std::strerror(why)));
  }
}

nlohmann::json read_json(const std::string& path) {
  std::ifstream file(path);
  if (!file)
    throw InputError(
        fmt::format("{}: cannot be read ({}); give an existing file", path, std::strerror(errno)));
  try {
    return nlohmann::json::parse(file);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: is not whole JSON ({}); write it again", path, error.what()));
  }
}

}  // namespace palpate
