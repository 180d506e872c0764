#include "deploy/palpate/progress.h"

#include <unistd.h>

#include <cstdio>
#include <string>

namespace palpate::deploy {

void show_progress(double t, double seconds) {
  if (isatty(STDERR_FILENO) == 0) return;
  const int done = static_cast<int>(40 * t / seconds);
  std::fprintf(stderr, "\r  [%-40s] %.2f of %.2f s", std::string(static_cast<std::size_t>(done), '=').c_str(),
               t, seconds);
  if (t >= seconds) std::fputc('\n', stderr);
}

}  // namespace palpate::deploy
