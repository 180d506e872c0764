#include "deploy/import/quiet_stderr.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>

namespace palpate {

QuietStderr::QuietStderr() : kept_(dup(STDERR_FILENO)) {
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (kept_ < 0 || nowhere < 0) return;  // better loud than lost
  dup2(nowhere, STDERR_FILENO);
  ::close(nowhere);
}

QuietStderr::~QuietStderr() {
  if (kept_ < 0) return;
  std::cerr.flush();
  std::fflush(stderr);
  dup2(kept_, STDERR_FILENO);
  ::close(kept_);
}

}  // namespace palpate
