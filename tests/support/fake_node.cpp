// Stands in for palpate-physics, -haptic or -render in tests of the supervisor; which one, its own file name says.
// It publishes NodeStatus as running, and when told to stop writes its part and the time it was told.
//
// FAKE_<NODE> (FAKE_PHYSICS, ...) in the environment makes it misbehave:
//   crash: abort once running    mistake: exit 2 at once      hang: ignores SIGTERM
//   leave: exit 0 once running   mute: never says anything    slow: loads for a second
//   behind: simulates half as fast as time goes

#include <time.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "common/process/stop_flag.h"
#include "common/report/json_file.h"
#include "common/wire/writer.h"

namespace {

using namespace palpate;
using namespace std::chrono_literals;

std::string option(int argc, char** argv, const std::string& name) {
  for (int i = 1; i + 1 < argc; ++i) {
    if (argv[i] == name) return argv[i + 1];
  }
  return {};
}

std::int64_t now_ns() {
  timespec now = {};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1000000000 + now.tv_nsec;
}

NodeKind kind_of(const std::string& name) {
  if (name == "haptic") return NodeKind::haptic;
  return name == "render" ? NodeKind::render : NodeKind::physics;
}

std::string whim_of(std::string name) {
  for (char& letter : name) letter = static_cast<char>(std::toupper(letter));
  const char* whim = std::getenv(("FAKE_" + name).c_str());
  return whim == nullptr ? "" : whim;
}

void leave_part(const std::string& out, const std::string& name) {
  nlohmann::json part = {{name, {{"told_ns", now_ns()}, {"pid", getpid()}}}};
  if (name == "physics") part["simulated_s"] = 1.5;
  write_json(out + "/parts/" + name + ".json", part);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string name =
      std::filesystem::path(argv[0]).filename().string().substr(std::string("palpate-").size());
  const std::string whim = whim_of(name);
  if (whim == "mistake") return 2;
  install_stop_handlers();
  if (whim == "hang") std::signal(SIGTERM, SIG_IGN);
  Participant participant(std::stoi(option(argc, argv, "--domain")));
  Writer<NodeStatus> writer(participant);
  NodeStatus status;
  status.node = kind_of(name);
  status.pid = static_cast<std::uint32_t>(getpid());
  status.rate_Hz = 1000;
  const auto start = std::chrono::steady_clock::now();
  while (!stop_requested()) {
    const auto age = std::chrono::steady_clock::now() - start;
    status.t = (whim == "behind" ? 0.5 : 1) * std::chrono::duration<double>(age).count();
    status.phase = whim == "slow" && age < 1s ? NodePhase::loading : NodePhase::running;
    if (whim != "mute") writer.write(status);
    if (whim == "crash" && age > 700ms) std::abort();
    if (whim == "leave" && age > 700ms) break;
    for (int i = 0; i < 20 && !stop_requested(); ++i) std::this_thread::sleep_for(5ms);
  }
  leave_part(option(argc, argv, "--out"), name);
  return 0;
}
