#include "bench/wire/scene_traffic.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "bench/wire/two_ends.h"
#include "common/report/json_file.h"
#include "deploy/palpate/child.h"
#include "deploy/palpate/install_paths.h"

namespace palpate::bench {

std::optional<Traffic> measure_scene_traffic(const std::string& scene, const std::string& nodes,
                                             double seconds) {
  namespace fs = std::filesystem;
  const fs::path out = fs::temp_directory_path() / fmt::format("palpate_bench_wire_{}", getpid());
  fs::remove_all(out);
  fs::create_directories(out);
  deploy::Child run(
      "/bin/sh", {"-c", fmt::format("exec '{}' run '{}' --headless --nodes {} --seconds {} --domain {} --out "
                                    "'{}' >'{}/said' 2>&1",
                                    (deploy::bin_folder() / "palpate").string(), scene, nodes, seconds,
                                    bench_domain, out.string(), out.string())});
  const bool clean = run.wait().clean();
  const fs::path file = out / "summary.json";
  std::optional<Traffic> traffic;
  if (clean && fs::exists(file)) {
    const auto summary = read_json(file.string());
    traffic.emplace();
    traffic->wall_s = summary.at("wall_s");
    traffic->publish_share = summary["stages"]["publish"]["total_s"].get<double>() / traffic->wall_s;
    for (const auto& [node, report] : summary.at("wire").items()) {
      traffic->shared = report.at("shared_memory");
      for (const auto& [topic, counts] : report.items()) {
        if (!counts.is_object()) continue;
        traffic->topics[topic].samples += counts.at("samples").get<double>();
        traffic->topics[topic].bytes += counts.at("bytes").get<double>();
      }
    }
  } else {
    fmt::print(stderr, "palpate bench: {}: the session failed; see {}\n", scene, (out / "said").string());
    return {};
  }
  fs::remove_all(out);
  return traffic;
}

}  // namespace palpate::bench
