#pragma once
// A row of `palpate bench haptic` as a test, with some of its cases.

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "bench/haptic/rows.h"

namespace palpate::bench {

inline Runs quick() {
  Runs runs;
  runs.effort = Effort::quick;
  return runs;
}

inline void expect(const Row& row) {
  EXPECT_TRUE(row.pass) << row.id << ": " << row.what << "\n  limit: " << row.limit << "\n  " << row.figure;
}

using MatrixRow = Row (*)(Runs&);

inline const auto by_name = [](const auto& which) { return std::string(which.param.first); };

class InAMatrix : public ::testing::TestWithParam<std::pair<const char*, MatrixRow>> {};

TEST_P(InAMatrix, KeepsItsLimitsAndItsForceSteps) {
  Runs runs = quick();
  expect(GetParam().second(runs));
  if (!runs.seen.empty()) expect(force_steps_are_small(runs));
}

}  // namespace palpate::bench
