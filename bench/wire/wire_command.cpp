// palpate bench wire: what it costs that the nodes are processes of their own, over UDP loopback and through shared memory.

#include <fmt/format.h>

#include <memory>

#include "bench/machine/result_folder.h"
#include "bench/subcommands.h"
#include "bench/wire/round_trips.h"
#include "bench/wire/scene_traffic.h"
#include "bench/wire/topic_cost.h"
#include "common/error/error.h"
#include "common/process/checked_option.h"
#include "common/wire/reach.h"
#include "common/wire/shared_memory.h"

namespace palpate::bench {
namespace {

struct Options {
  std::string out = "out/bench_wire";
  std::string scenes = "box_press";
  std::string scene_folder = "scenes";
  std::string nodes = "physics,haptic,render";
  int rounds = 500;
  int samples = 1000;
  double seconds = 5;
};

struct Way {
  Path path;
  bool loaned;
  const char* name;
};

std::vector<Way> ways() {
  const RouDi found = look_for_roudi();
  fmt::print("{}\n", words(found));
  std::vector<Way> all = {{Path::udp, false, "udp"}};
  if (found == RouDi::ready) {
    all.push_back({Path::memory, false, "memory"});
    all.push_back({Path::memory, true, "memory_loaned"});
  }
  return all;
}

void round_trips(const Options& options, const std::vector<Way>& ways, nlohmann::json& json, Table& table) {
  fmt::print("\n{:>9} {:14} {:>8} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "bytes", "way", "answered", "p50 us",
             "p99 us", "max us", "write us", "cpu us");
  for (const std::size_t size : payload_sizes()) {
    for (const Way& way : ways) {
      const auto trips = measure_round_trips(size, way.path, way.loaned, options.rounds);
      if (!trips || trips->shared != (way.path == Path::memory)) {
        fmt::print("{:9} {:14} did not meet that way\n", size, way.name);
        continue;
      }
      fmt::print("{:9} {:14} {:8} {:9.1f} {:9.1f} {:9.1f} {:9.1f} {:9.1f}\n", size, way.name, trips->answered,
                 trips->p50_us, trips->p99_us, trips->max_us, trips->write_p50_us, trips->cpu_us);
      table.add({"round_trip", std::to_string(size), way.name, std::to_string(trips->answered),
                 text_of(trips->p50_us), text_of(trips->p99_us), text_of(trips->max_us),
                 text_of(trips->write_p50_us), text_of(trips->cpu_us)});
      json["round_trips"][std::to_string(size)][way.name] = {{"answered", trips->answered},
                                                             {"rounds", options.rounds},
                                                             {"p50_us", trips->p50_us},
                                                             {"p99_us", trips->p99_us},
                                                             {"max_us", trips->max_us},
                                                             {"write_p50_us", trips->write_p50_us},
                                                             {"cpu_us_per_round_one_end", trips->cpu_us}};
    }
  }
}

using Costs = std::map<std::string, double>;  // processor time a sample at both ends [us], by topic

Costs topics(const Options& options, const Way& way, nlohmann::json& json) {
  Costs costs;
  fmt::print("\n{:14} {:>14} {:>9} {:>9} {:>9}\n", "topic", "way", "write us", "read us", "arrived");
  for (const TopicCost& cost : measure_topics(way.path, options.samples)) {
    fmt::print("{:14} {:>14} {:9.1f} {:9.1f} {:9.3f}\n", cost.topic, way.name, cost.write_us, cost.read_us,
               cost.arrived);
    json["topics"][cost.topic][way.name] = {
        {"write_cpu_us", cost.write_us}, {"read_cpu_us", cost.read_us}, {"arrived", cost.arrived}};
    costs[cost.topic] = cost.write_us + cost.read_us;
  }
  return costs;
}

void scenes(const Options& options, const Costs& costs, nlohmann::json& json) {
  for (const std::string& name : comma_list(options.scenes)) {
    const auto traffic = measure_scene_traffic(fmt::format("{}/{}.toml", options.scene_folder, name),
                                               options.nodes, options.seconds);
    if (!traffic) continue;
    fmt::print("\n{} ({}), telling the eye takes {:.2f} % of physics' time\n{:14} {:>10} {:>10} {:>10}\n",
               name, traffic->shared ? "shared memory" : "udp", 100 * traffic->publish_share, "topic",
               "samples/s", "kB/s", "% of a core");
    auto& scene = json["scenes"][name];
    scene = {{"shared_memory", traffic->shared},
             {"publish_share", traffic->publish_share},
             {"nodes", options.nodes}};
    double bytes = 0, core = 0;
    for (const auto& [topic, said] : traffic->topics) {
      const double rate = said.samples / traffic->wall_s;
      const double share = costs.count(topic) > 0 ? 1e-6 * rate * costs.at(topic) : 0;
      fmt::print("{:14} {:10.1f} {:10.1f} {:10.2f}\n", topic, rate, 1e-3 * said.bytes / traffic->wall_s,
                 100 * share);
      scene["topics"][topic] = {
          {"samples_per_s", rate}, {"bytes_per_s", said.bytes / traffic->wall_s}, {"core_share", share}};
      bytes += said.bytes / traffic->wall_s;
      core += share;
    }
    fmt::print("{:14} {:>10} {:10.1f} {:10.2f}\n", "all", "", 1e-3 * bytes, 100 * core);
    scene["bytes_per_s"] = bytes;
    scene["core_share"] = core;
  }
}

int run_wire(const Options& options) {
  if (options.samples == 0 && !options.scenes.empty())
    throw InputError(
        "--samples 0: without the cost of a sample no share of a core is known for --scenes; give --samples "
        "1 or more, or "
        "--scenes \"\"");
  const ResultFolder folder(options.out, "wire");
  Table table{{"what", "bytes", "way", "answered", "p50_us", "p99_us", "max_us", "write_p50_us", "cpu_us"},
              {}};
  nlohmann::json json;
  const auto all = ways();
  if (options.rounds > 0) round_trips(options, all, json, table);
  Costs costs;
  for (const Way& way : all)
    if (!way.loaned && options.samples > 0) costs = topics(options, way, json);
  scenes(options, costs, json);
  folder.write_csv(table);
  folder.write_json(json);
  fmt::print("\nresults: {}\n", options.out);
  return exit_ok;
}

}  // namespace

void add_wire(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("wire", "what topics cost, over UDP loopback and through shared memory");
  auto options = std::make_shared<Options>();
  command->add_option("--out", options->out, "folder of the results")->capture_default_str();
  command->add_option("--scenes", options->scenes, "names of scenes to run live, separated by commas")
      ->capture_default_str();
  command->add_option("--scene-folder", options->scene_folder, "where they are")->capture_default_str();
  command->add_option("--nodes", options->nodes, "nodes of these sessions")->capture_default_str();
  command->add_option("--seconds", options->seconds, "of each session")
      ->capture_default_str()
      ->check(number_in(run_seconds));
  command->add_option("--rounds", options->rounds, "there and back, of each size; 0: left out")
      ->capture_default_str()
      ->check(CLI::Range(0, 1'000'000));
  command->add_option("--samples", options->samples, "of each topic; 0: left out, which needs --scenes \"\"")
      ->capture_default_str()
      ->check(CLI::Range(0, 1'000'000));
  command->callback([options, &exit_code] { exit_code = run_wire(*options); });
}

}  // namespace palpate::bench
