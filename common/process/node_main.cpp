#include "common/process/node_main.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <thread>

#include "common/error/error.h"
#include "common/file/privacy.h"
#include "common/process/checked_option.h"
#include "common/process/command_line.h"
#include "common/process/other_process.h"
#include "common/process/stop_flag.h"
#include "common/report/log.h"
#include "common/scene/load_scene.h"
#include "common/scene/scene.h"
#include "common/scene/scene_source.h"
#include "common/time/clock.h"

namespace palpate {
namespace {

constexpr std::int64_t newcomer_ns = 3'000'000'000;  // discovery repeats itself every second
constexpr std::int64_t company_answers_ns =
    30'000'000;  // who is there answers a newcomer at once, one after the other
constexpr std::int64_t alone_ns = 200'000'000;
constexpr std::size_t most_named = 20;

}  // namespace

Membership membership(const NodeOptions& options, const Scene& scene, const std::string& role) {
  return {.domain = options.domain,
          .reach = options.reach,
          .identity = own_identity(role, scene.path, scene.checksum),
          .shared_memory = true};
}

Newcomer::Newcomer(Participant& participant, const Identity& own)
    : companions_(participant, own), own_(own), began_ns_(now_ns()) {}

void Newcomer::settle() {
  std::int64_t company_ns = 0;  // when somebody was seen first
  while (!stop_requested()) {
    const std::int64_t now = now_ns();
    if (company_ns == 0 && !companions_.present().empty()) company_ns = now;
    if (now - began_ns_ > alone_ns || (company_ns > 0 && now - company_ns > company_answers_ns)) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  const auto reasons = reasons_to_go();
  if (!reasons.empty()) throw InputError(reasons);
}

/// Of two on one machine the one that was started first stays. Clocks of two machines are not compared: the newcomer goes.
/// A supervisor sends nothing that counts, so that it may look in.
std::vector<std::string> Newcomer::reasons_to_go() {
  const auto came_later = [this](const Identity& other) {
    return other.host == own_.host && started_before(own_.pid, other.pid);
  };
  std::vector<std::string> lines;
  for (const Identity& other : companions_.present()) {
    if (other.role == "supervisor" || came_later(other)) continue;
    if (std::string line = difference(own_, other); !line.empty()) lines.push_back(std::move(line));
  }
  for (const Identity& other : companions_.doubles()) {
    if (came_later(other)) continue;
    lines.push_back(fmt::format(
        "{} is in this session already, on {} (pid {}); end it first, or give this one another --domain",
        other.role, other.host, other.pid));
  }
  return lines;
}

void Newcomer::name_doubles() {
  for (const Identity& other : companions_.doubles()) {
    const bool known = std::any_of(named_.begin(), named_.end(), [&](const Identity& one) {
      return one.pid == other.pid && one.host == other.host;
    });
    if (known || named_.size() >= most_named) continue;
    named_.push_back(other);
    log_warn("another {} has come, on {} (pid {}); this one was here first and stays", other.role, other.host,
             other.pid);
  }
}

bool Newcomer::must_go() {
  if (now_ns() - began_ns_ <= newcomer_ns) {
    const auto reasons = reasons_to_go();
    for (const auto& line : reasons) log_error("{}", line);
    if (!reasons.empty()) return true;
  }
  name_doubles();
  return false;
}

int node_main(int argc, char** argv, const char* name,
              const std::function<int(const NodeOptions&, const Scene&)>& run) {
  NodeOptions options;
  std::string peers;
  CLI::App app{std::string(name) + ": one node of palpate"};
  add_version(app, name);
  app.add_option("scene", options.scene_path, "scene file (TOML)")->required();
  app.add_option("--set", options.settings, "table.key=value over the scene; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--out", options.out, "folder for what this node leaves");
  app.add_option("--domain", options.domain, "DDS domain, 0 to 100")->check(CLI::Range(0, 100));
  app.add_option("--interface", options.reach.interface,
                 "network interface or its address; else this machine only");
  app.add_option("--peers", peers, "other machines, by name or address, separated by commas");
  app.add_option("--seconds", options.seconds, "simulated time after which to stop")
      ->check(number_in({.lo = 0, .hi = run_seconds.hi}));
  app.add_option("--from", options.from, "physics: record of the same scene to begin from");
  app.add_option("--at", options.at, "simulated time of that record; else its end")
      ->check(number_in(run_seconds));
  app.add_option("--device", options.device, "driver instead of the scene's");
  app.add_flag("--headless", options.headless, "frames to files instead of a window");
  app.add_flag("--require-rt", options.require_rt, "fail without real-time rights");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    return app.exit(asked);
  } catch (const CLI::ParseError& error) {
    std::fprintf(stderr, "%s: %s; see %s --help\n", name, mistake_text(app, error).c_str(), name);
    return exit_mistake;
  }
  try {
    options.reach.peers = comma_list(peers);
    install_stop_handlers();
    const Scene scene = load_scene(options.scene_path, options.settings);
    keep_as_private_as(files_of(scene));
    if (!options.from.empty()) keep_as_private_as({options.from});
    const int code = run(options, scene);
    if (stopped_by() == "iox-roudi")
      log_warn("RouDi was stopped, and has told the programs that use its memory to end");
    return code;
  } catch (const InputError& error) {
    for (const auto& line : error.complaints()) std::fprintf(stderr, "%s: %s\n", name, line.c_str());
    return exit_mistake;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return exit_failed;
  }
}

}  // namespace palpate
