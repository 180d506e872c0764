#pragma once
// One row of `palpate bench kernel`, and the files that the rows go into.

#include <vector>

#include "bench/kernel/work.h"
#include "bench/machine/result_folder.h"
#include "bench/problems/cube.h"

namespace palpate::bench {

struct KernelRow {
  CubeKind kind;
  int threads = 1;
  std::int64_t masses = 0, elements = 0;
  MassWork work;
  double stable_step = 0;  // [s]
  std::vector<double> ns;  // per mass and step, of each repetition, wall time

  double median_ns() const;
  double least_ns() const;
  /// Simulated per wall time with frames of 1 ms and steps of at most 0.8 of the stable one.
  double real_time_factor() const;
};

/// kernel.csv, kernel.json with the limits of the machine, kernel.png. @return true if all could be drawn
bool write_kernel_results(const ResultFolder& folder, const std::vector<KernelRow>& rows);

/// One line for a person.
std::string line_of(const KernelRow& row);

}  // namespace palpate::bench
