#include "common/process/node_main.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "common/error/error.h"
#include "common/process/checked_option.h"
#include "common/process/stop_flag.h"
#include "common/report/log.h"
#include "common/scene/load_scene.h"
#include "common/time/clock.h"

namespace palpate {
namespace {

constexpr std::int64_t newcomer_ns = 3'000'000'000;  // discovery repeats itself every second

}  // namespace

Membership membership(const NodeOptions& options, const Scene& scene, const std::string& role) {
  return {.domain = options.domain,
          .reach = options.reach,
          .identity = own_identity(role, scene.path, scene.checksum),
          .shared_memory = true};
}

Newcomer::Newcomer(Participant& participant) : companions_(participant), until_ns_(now_ns() + newcomer_ns) {}

bool Newcomer::must_go() {
  if (now_ns() > until_ns_) return false;
  const auto differences = companions_.differences(false);
  for (const auto& line : differences) log_error("{}", line);
  return !differences.empty();
}

int node_main(int argc, char** argv, const char* name,
              const std::function<int(const NodeOptions&, const Scene&)>& run) {
  NodeOptions options;
  std::string peers;
  CLI::App app{std::string(name) + ": one node of palpate"};
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
  app.add_option("--device", options.device, "driver instead of the scene's");
  app.add_flag("--headless", options.headless, "frames to files instead of a window");
  app.add_flag("--require-rt", options.require_rt, "fail without real-time rights");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_ok : exit_mistake;
  }
  try {
    options.reach.peers = comma_list(peers);
    install_stop_handlers();
    const int code = run(options, load_scene(options.scene_path, options.settings));
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
