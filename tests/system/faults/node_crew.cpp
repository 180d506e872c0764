#include "tests/system/faults/node_crew.h"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <iterator>

namespace palpate::test {

const char* name_of(NodeKind node) {
  if (node == NodeKind::physics) return "physics";
  return node == NodeKind::haptic ? "haptic" : "render";
}

NodeCrew::NodeCrew(std::filesystem::path programs, std::filesystem::path folder, int domain)
    : programs_(std::move(programs)), folder_(std::move(folder)), domain_(domain) {
  std::filesystem::create_directories(folder_ / "out");
}

NodeCrew::~NodeCrew() {
  for (const NodeKind node : crew_nodes) kill_now(node);
}

void NodeCrew::start(NodeKind node) {
  const std::string program = (programs_ / (std::string("palpate-") + name_of(node))).string();
  const std::string scene = (folder_ / "scene.toml").string(), out = (folder_ / "out").string();
  const std::string number = std::to_string(domain_), log = (folder_ / "log").string();
  const pid_t pid = fork();
  if (pid == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // a test that is killed leaves nobody behind
    if (std::freopen(log.c_str(), "a", stderr) == nullptr) _exit(126);
    execl(program.c_str(), program.c_str(), scene.c_str(), "--out", out.c_str(), "--domain", number.c_str(),
          "--headless", nullptr);
    _exit(127);
  }
  slot(node) = pid;
  ever_.push_back(pid);
}

void NodeCrew::signal(NodeKind node, int number) const { kill(pid(node), number); }

bool NodeCrew::has_ended(NodeKind node, int& status) {
  if (pid(node) <= 0) return true;
  if (waitpid(pid(node), &status, WNOHANG) != pid(node)) return false;
  slot(node) = -1;
  return true;
}

void NodeCrew::kill_now(NodeKind node) {
  if (pid(node) <= 0) return;
  kill(pid(node), SIGKILL);
  waitpid(pid(node), nullptr, 0);
  slot(node) = -1;
}

std::vector<std::string> NodeCrew::crashed() {
  std::vector<std::string> lines;
  for (const NodeKind node : crew_nodes) {
    int status = 0;
    if (pid(node) <= 0 || waitpid(pid(node), &status, WNOHANG) != pid(node)) continue;
    lines.push_back(std::string(name_of(node)) +
                    (WIFSIGNALED(status) ? " died of signal " + std::to_string(WTERMSIG(status))
                                         : " left with exit code " + std::to_string(WEXITSTATUS(status))));
    slot(node) = -1;
  }
  return lines;
}

std::string NodeCrew::log() const {
  std::ifstream file(folder_ / "log");
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace palpate::test
