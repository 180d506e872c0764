#include "common/file/new_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace palpate {

bool make_way(const std::string& path) noexcept { return unlink(path.c_str()) == 0 || errno == ENOENT; }

std::FILE* open_new(const std::string& path) noexcept {
  if (!make_way(path)) return nullptr;
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file < 0) return nullptr;
  std::FILE* stream = fdopen(file, "wb");
  if (stream != nullptr) return stream;
  const int why = errno;
  close(file);
  errno = why;
  return nullptr;
}

}  // namespace palpate
