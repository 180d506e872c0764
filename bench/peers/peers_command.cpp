// palpate bench peers: the same springs, and a beam of finite elements, in palpate and in other engines, in one run.

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

#include "bench/machine/result_folder.h"
#include "bench/peers/beam_peers.h"
#include "bench/peers/measure.h"
#include "bench/peers/report.h"
#include "bench/subcommands.h"
#include "common/error/error.h"

namespace palpate::bench {
namespace {

struct PeersOptions {
  std::string out = "out/bench_peers";
  bool quick = false;
};

/// A line that overwrites itself on a terminal, nothing elsewhere.
void show_progress(const std::string& what) {
  if (isatty(STDERR_FILENO) != 0) std::fprintf(stderr, "\r\033[K  %s", what.c_str());
}

int compare(const PeersOptions& options) {
  const ResultFolder folder(options.out, "peers");
  Plan plan;
  if (options.quick) plan = {1000, 50, {1000}, 0.02, 1};
  std::vector<Peer> peers;
  peers.push_back(palpate_peer());
  peers.push_back(lammps_peer());
  peers.push_back(bullet_peer());
  peers.push_back(mujoco_peer());
  for (const Peer& peer : peers) {
    if (peer.version.empty())
      fmt::print("{}: not found (apt-get install {})\n", peer.name, peer.package);
    else
      fmt::print("{} {}\n", peer.name, peer.version);
  }
  std::fflush(stdout);

  Results results;
  results.agreement = measure_agreement(peers);
  results.drop = measure_drop(plan, peers, show_progress);
  results.steps = measure_steps(plan, peers, show_progress);
  show_progress("");
  folder.write_csv(table_of(results));
  print(results, peers);
  nlohmann::json json = json_of(results, peers);
  json["beam"] = compare_beams(options.quick);
  folder.write_json(json);
  const bool drawn = folder.plot();
  fmt::print("\nresults {}\n", folder.file(".csv").string());
  return drawn ? exit_ok : exit_failed;
}

}  // namespace

void add_peers(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<PeersOptions>();
  CLI::App* command =
      app.add_subcommand("peers", "the same springs and finite elements in other engines, where installed");
  command->add_option("--out", options->out, "folder for the results")->capture_default_str();
  command->add_flag("--quick", options->quick, "small bodies, once: does it work, not how fast");
  command->callback([options, &exit_code] { exit_code = compare(*options); });
}

}  // namespace palpate::bench
