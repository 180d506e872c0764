// palpate bench contact: what contact costs beside the elements, and that it costs nothing where nothing is near.

#include <fmt/format.h>

#include <memory>

#include "bench/contact/contact_cost.h"
#include "bench/machine/result_folder.h"
#include "bench/subcommands.h"
#include "common/error/error.h"

namespace palpate::bench {
namespace {

int run_contact(const std::string& out) {
  const ResultFolder folder(out, "contact");
  nlohmann::json json;
  fmt::print("{:22} {:>10} {:>8} {:>10} {:>9} {:>12} {:>11} {:>22}\n", "", "candidates", "pairs",
             "collisions", "rebuilds", "contact", "elements", "20,000 candidates over");
  fmt::print("{:22} {:>10} {:>8} {:>10} {:>9} {:>12} {:>11} {:>22}\n", "", "", "", "", "a step", "us a step",
             "us a step", "100,000 masses");
  for (const ContactCost& c : measure_contact_costs()) {
    fmt::print("{:22} {:10} {:8} {:10} {:9.2f} {:12.1f} {:11.1f} {:22.2f}\n", c.name, c.candidates, c.pairs,
               c.collisions, c.rebuilds_per_step, c.contact_us, c.kernel_us, c.ratio());
    json.push_back({{"name", c.name},
                    {"candidates", c.candidates},
                    {"pairs", c.pairs},
                    {"collisions", c.collisions},
                    {"rebuilds_per_step", c.rebuilds_per_step},
                    {"contact_us_per_step", c.contact_us},
                    {"elements_us_per_step", c.kernel_us},
                    {"masses", c.masses},
                    {"steps", c.steps},
                    {"steps_without_contact", c.skipped},
                    {"ratio_20000_candidates_to_100000_masses", c.ratio()}});
  }
  folder.write_json(json);
  fmt::print("results: {}\n", out);
  return exit_ok;
}

}  // namespace

void add_contact(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("contact", "what contact costs beside the elements");
  auto out = std::make_shared<std::string>("out/bench_contact");
  command->add_option("--out", *out, "folder of the results")->capture_default_str();
  command->callback([out, &exit_code] { exit_code = run_contact(*out); });
}

}  // namespace palpate::bench
