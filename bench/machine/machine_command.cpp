// palpate bench machine

#include <fmt/format.h>

#include <cstdio>

#include "bench/machine/limits.h"
#include "bench/machine/machine.h"
#include "bench/subcommands.h"

namespace palpate::bench {

void add_machine(CLI::App& app, int&) {
  auto* command = app.add_subcommand("machine", "what this machine can do at most, as JSON");
  command->callback([] {
    nlohmann::json json = machine();
    for (const bool single : {true, false}) {
      const std::string precision = single ? "single" : "double";
      json["fma_Gflop_per_s"][precision] = 1e-9 * fma_flops_per_s(single);
      json["multiply_add_Gflop_per_s"][precision] = 1e-9 * multiply_add_flops_per_s(single);
    }
    for (const int kB : {32, 512, 8192, 262144})
      for (const int threads : {1, 2})
        json["triad_GB_per_s"][fmt::format("{}_kB", kB)][fmt::format("{}_threads", threads)] =
            1e-9 * triad_bytes_per_s(static_cast<std::size_t>(kB) * 1024, threads);
    std::puts(json.dump(2).c_str());
  });
}

}  // namespace palpate::bench
