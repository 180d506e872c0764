// A file that is no record of a session is refused in words, before it costs memory.
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "common/error/error.h"
#include "common/record/hdf5_file.h"
#include "physics_node/record/session_record.h"
#include "tests/support/image/scratch_folder.h"

namespace palpate::physics {
namespace {

using palpate::test::ScratchFolder;

/// A few kilobytes of file that claim, and hold, a scene of megabytes of blanks: refused by its shape, before it is read.
TEST(RefusedRecord, HasAListLongerThanThatOfAnySession) {
  const ScratchFolder folder;
  const auto complaint_about = [&](const std::string& dataset, std::uint64_t n) {
    {
      Hdf5File file(folder / "big.h5", Hdf5File::Mode::record);
      file.set_text("palpate_record", "2");
      file.set_text("commit", "none");
      for (const char* empty : {"hashes", "flushed", "commands"})
        file.write<std::uint64_t>(std::string("/session/") + empty, {0}, nullptr);
      file.write<double>("/session/command_values", {0}, nullptr);
      file.write<std::uint8_t>("/session/command_names", {0, 64}, nullptr);
      const std::vector<std::uint8_t> blanks(n, ' ');
      file.write<std::uint8_t>(dataset, {n}, blanks.data());
    }
    try {
      const SessionRecord record(folder / "big.h5");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  constexpr std::uint64_t limit = 1 << 24;
  for (const char* dataset : {"/scene/text", "/scene/settings", "/scene/files"}) {
    EXPECT_EQ(complaint_about(dataset, limit), "") << dataset;
    EXPECT_NE(complaint_about(dataset, limit + 1)
                  .find(std::string("dataset ") + dataset + " has 16777217 numbers; at most 16777216"),
              std::string::npos)
        << complaint_about(dataset, limit + 1);
  }
}

TEST(RefusedRecord, IsNoneAtAll) {
  const ScratchFolder folder;
  EXPECT_THROW(SessionRecord(folder / "nothing.h5"), InputError);
  std::ofstream(folder / "text.h5") << "no record";
  EXPECT_THROW(SessionRecord(folder / "text.h5"), InputError);
  { Hdf5File(folder / "empty.h5", Hdf5File::Mode::create); }
  EXPECT_THROW(SessionRecord(folder / "empty.h5"), InputError);
}
}  // namespace
}  // namespace palpate::physics
