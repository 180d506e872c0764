#pragma once
// Many scenes in processes of their own, so that a crash is caught and known by its seed.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bench/stress/stress_run.h"

namespace palpate::bench {

struct Crash {
  std::uint64_t seed = 0;
  std::string how;  // "signal 11 (Segmentation fault)", "no answer in 300 s of CPU time", "exit code 1"
};

struct BatchResults {
  std::vector<StressResult> results;  // by seed
  std::vector<Crash> crashes;
};

/// Runs the seeds [first, first + n) in `jobs` processes at a time. Must be called before this process has started a
/// thread. @param folder  for files that are gone when it returns
/// @param done  called now and then with the number of scenes that are over
BatchResults run_batches(std::uint64_t first, std::uint64_t n, ElementModel model, int jobs,
                         const std::filesystem::path& folder, const std::function<void(std::uint64_t)>& done);

}  // namespace palpate::bench
