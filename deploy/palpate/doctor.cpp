// palpate doctor

#include "deploy/palpate/doctor.h"

#include <algorithm>
#include <cstdio>

#include "common/error/error.h"
#include "deploy/palpate/subcommands.h"

namespace palpate::deploy {
namespace {

const char* word(Finding::State state) {
  switch (state) {
    case Finding::State::ok:
      return "ok";
    case Finding::State::lacks:
      return "lacks";
    case Finding::State::fails:
      return "fails";
  }
  return "unknown";
}

}  // namespace

std::vector<Finding> check_all() {
  std::vector<Finding> findings = {check_nodes(),     check_wire(),        check_gl(),
                                   check_plotter(),   check_processor(),   check_timer(),
                                   check_real_time(), check_memory_lock(), check_shared_memory()};
  const auto drivers = check_drivers();
  findings.insert(findings.begin() + 3, drivers.begin(), drivers.end());
  return findings;
}

void add_doctor(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("doctor", "check this machine: rights, DDS, GL, drivers");
  command->callback([&exit_code] {
    const auto findings = check_all();
    for (const auto& finding : findings) {
      std::printf("%-6s %-14s %s\n", word(finding.state), finding.name.c_str(), finding.text.c_str());
    }
    const bool broken = std::any_of(findings.begin(), findings.end(), [](const Finding& finding) {
      return finding.state == Finding::State::fails;
    });
    exit_code = broken ? exit_failed : exit_ok;
  });
}

}  // namespace palpate::deploy
