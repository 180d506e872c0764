#include "common/record/part_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "common/error/error.h"
#include "common/file/new_file.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;

std::string part_beside(const std::string& path) {
  std::error_code ignored;
  if (path.empty()) throw InputError("output: no file name given; name one");
  if (fs::is_directory(path, ignored)) throw InputError(path + ": is a folder; name a file to write in it");
  const fs::path folder = fs::path(path).parent_path();
  if (!folder.empty() && !fs::is_directory(folder, ignored))
    throw InputError(path + ": there is no folder " + folder.string() + "; make it first");
  return path + ".part";
}

}  // namespace

PartFile::PartFile(std::string path) : path_(std::move(path)), part_(part_beside(path_)) {
  std::FILE* file = open_new(part_);
  if (file == nullptr)
    throw InputError(path_ + ": cannot be written (" + std::strerror(errno) + "); name a place that can");
  std::fclose(file);
}

PartFile::~PartFile() {
  std::error_code ignored;
  if (!committed_) fs::remove(part_, ignored);
}

void PartFile::commit() {
  std::error_code trouble;
  fs::rename(part_, path_, trouble);
  if (trouble)
    throw InputError(path_ + ": cannot be replaced (" + trouble.message() + "); name another file");
  committed_ = true;
}

void remove_part(const std::string& path) noexcept {
  std::error_code ignored;
  fs::remove(path + ".part", ignored);
}

void check_can_write(const std::string& path) { const PartFile trial(path); }

}  // namespace palpate
