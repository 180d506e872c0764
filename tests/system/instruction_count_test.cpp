// The kernels do not grow unnoticed: instructions per mass and step, counted by callgrind, which no other load on the
// machine disturbs, against those in bench/instruction_counts.json. bench/record_instruction_counts.sh writes them anew.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "tests/system/shell.h"

namespace palpate {
namespace {

constexpr double margin = 0.05;
constexpr int steps = 10;

struct Kernel {
  const char *isa, *elements, *precision, *work;
  std::string name() const { return std::string(isa) + "/" + elements + "/" + precision + "/" + work; }
};

std::vector<Kernel> kernels() {
  std::vector<Kernel> all;
  for (const char* isa : {"sse2", "avx2"}) {
    if (std::string(isa) == "avx2" && !__builtin_cpu_supports("avx2")) continue;
    for (const char* lattice : {"fcc", "voxel"}) {
      for (const char* work : {"undamped", "damped", "plastic", "yielding"})
        all.push_back({isa, lattice, "single", work});
      all.push_back({isa, lattice, "double", "undamped"});
    }
    all.push_back({isa, "hexahedra", "single", "undamped"});
    if (std::string(isa) == "sse2") continue;  // minutes, and the loops are the same
    for (const char* work : {"damped", "relaxing", "isotropic", "breaking", "plastic", "yielding"})
      all.push_back({isa, "hexahedra", "single", work});
  }
  return all;
}

struct Count {
  double instructions = 0;
  double masses = 0;
};

/// Runs kernel_steps under callgrind.
Count count(const Kernel& kernel, int n_steps) {
  const std::string command = std::string("PALPATE_ISA=") + kernel.isa +
                              " " VALGRIND " --tool=callgrind --callgrind-out-file=/dev/null " +
                              test::quoted(KERNEL_STEPS) + " " + kernel.elements + " " + kernel.precision +
                              " " + kernel.work + " " + std::to_string(n_steps) + " 2>&1";
  std::string out;
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return {};
  std::array<char, 4096> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) out += buffer.data();
  EXPECT_EQ(pclose(pipe), 0) << out;
  std::smatch collected, masses;
  if (!std::regex_search(out, collected, std::regex("Collected : ([0-9]+)")) ||
      !std::regex_search(out, masses, std::regex("(^|\n)([0-9]+)\n"))) {
    ADD_FAILURE() << command << " did not say how many instructions it took:\n" << out;
    return {};
  }
  return {std::stod(collected[1]), std::stod(masses[2])};
}

/// Instructions per mass and step, without the set-up.
double per_mass_and_step(const Kernel& kernel) {
  const Count once = count(kernel, steps), twice = count(kernel, 2 * steps);
  return (twice.instructions - once.instructions) / (steps * once.masses);
}

TEST(Instructions, PerMassAndStepAreAsRecorded) {
  const std::string path = std::string(SOURCE) + "/bench/instruction_counts.json";
  const bool record = std::getenv("PALPATE_RECORD_INSTRUCTIONS") != nullptr;
  nlohmann::json kept;
  if (!record) {
    std::ifstream file(path);
    ASSERT_TRUE(file) << path << " is missing; run bench/record_instruction_counts.sh";
    kept = nlohmann::json::parse(file);
    if (kept["compiler"] != __VERSION__)
      GTEST_SKIP() << "counted with compiler " << kept["compiler"] << ", this is " << __VERSION__;
  }
  nlohmann::json now = {{"compiler", __VERSION__},
                        {"unit", "instructions per mass and step, callgrind, one thread"}};
  for (const Kernel& kernel : kernels()) {
    const double counted = per_mass_and_step(kernel);
    ASSERT_GT(counted, 1) << kernel.name();
    now["counts"][kernel.name()] = std::round(10 * counted) / 10;
    if (record) continue;
    const double before = kept["counts"].value(kernel.name(), 0.0);
    EXPECT_LT(counted, before * (1 + margin)) << kernel.name() << " takes more instructions than it did";
    EXPECT_GT(counted, before * (1 - margin))
        << kernel.name() << " takes fewer: keep that with bench/record_instruction_counts.sh";
  }
  if (record) std::ofstream(path) << now.dump(2) << "\n";
}

}  // namespace
}  // namespace palpate
