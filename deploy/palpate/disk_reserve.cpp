#include "deploy/palpate/disk_reserve.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "common/error/error.h"

namespace palpate::deploy {

DiskReserve::DiskReserve(const std::filesystem::path& folder) : file_(folder / "parts" / "reserve") {
  release();  // of a session that was killed
  const int file = open(file_.c_str(), O_CREAT | O_EXCL | O_NOFOLLOW | O_WRONLY | O_CLOEXEC, 0600);
  const int error = file < 0 ? errno : posix_fallocate(file, 0, bytes);
  if (file >= 0) close(file);
  if (error == 0) return;
  release();
  throw InputError(
      fmt::format("{}: has no room for results ({}); free some, or give another folder with --out",
                  folder.string(), std::strerror(error)));
}

void DiskReserve::release() noexcept {
  std::error_code gone;
  std::filesystem::remove(file_, gone);
}

}  // namespace palpate::deploy
