#include "tests/support/image/run_importer.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "tests/support/image/bytes.h"
#include "tests/support/image/scratch_folder.h"

namespace palpate::test {

Outcome run_importer(const std::vector<std::string>& arguments) {
  const ScratchFolder scratch;
  const std::string out = scratch / "out", err = scratch / "err";
  const char* folder = std::getenv("PALPATE_BIN");
  std::string program = std::string(folder == nullptr ? "." : folder) + "/palpate-import";
  std::vector<std::string> words = arguments;
  std::vector<char*> argv = {program.data()};
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    dup2(open(out.c_str(), O_CREAT | O_WRONLY, 0600), STDOUT_FILENO);
    dup2(open(err.c_str(), O_CREAT | O_WRONLY, 0600), STDERR_FILENO);
    execv(program.c_str(), argv.data());
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, file_bytes(out), file_bytes(err)};
}

}  // namespace palpate::test
