#include "bench/machine/machine.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <thread>

#include "common/report/commit.h"
#include "physics_node/step/lattice/element_context.h"

namespace palpate::bench {
namespace {

std::string cpu_model() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown";
}

}  // namespace

nlohmann::json machine() {
  double load = 0;
  const bool has_load = getloadavg(&load, 1) == 1;
  nlohmann::json json = {
      {"commit", commit()},
      {"compiler", std::string(__VERSION__)},
      {"flags", PALPATE_BENCH_FLAGS},
      {"cpu", cpu_model()},
      {"cores", std::thread::hardware_concurrency()},
      {"instruction_set", physics::name_of(physics::instruction_set())},
      {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))},
  };
  if (has_load) json["load"] = load;
  return json;
}

}  // namespace palpate::bench
