// Random strokes of a scalpel: what must hold after each holds, and what does not is told.
#include <gtest/gtest.h>

#include "bench/cuts/cut_run.h"
#include "tests/support/image/scratch_folder.h"

namespace palpate::bench {
namespace {

TEST(RandomCuts, LoseNothingAndAreTheSameAfterAResetOrUndone) {
  const test::ScratchFolder folder;
  std::int64_t opened = 0;
  // Of cells and springs the seventh was another after a reset: the number of steps was kept until a moment whose rounding went by how
  // long the world had run, and lists of pairs were as wide as those before.
  for (const CutKind kind :
       {CutKind::tetrahedra, CutKind::cells, CutKind::springs, CutKind::parts, CutKind::surfaces})
    for (const std::uint64_t seed : {2U, 7U}) {
      const CutResult result = run_cuts(kind, seed, folder.path());
      EXPECT_EQ(faults(result), "") << result.kind << " " << seed;
      opened += result.opened;
    }
  EXPECT_GT(opened, 50) << "something is cut";
}

TEST(RandomCuts, TellWhatDoesNotHold) {
  CutResult result;
  EXPECT_EQ(faults(result), "");
  result.finite = false;
  result.mass_off = 1e-6;
  result.angular_off = 2e-3;
  result.open_edges = 3;
  result.other_from = 12;
  result.undoes = false;
  EXPECT_EQ(
      faults(result),
      "not finite, mass off by 1e-06, momenta off by 0 and 0.002, 3 open edges, after a reset other from "
      "frame 12 on, undone to other bits");
  EXPECT_EQ(words(result).size(), cut_heading().size());
}

}  // namespace
}  // namespace palpate::bench
