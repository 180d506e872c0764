#include "physics_node/record/earlier_record.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "tests/support/image/scratch_folder.h"

namespace palpate::physics {
namespace {

using palpate::test::ScratchFolder;

void write(const std::string& path, const char* text) { std::ofstream(path) << text; }

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(EarlierRecord, IsSetAsideUnderANumberOfItsOwn) {
  const ScratchFolder folder;
  EXPECT_FALSE(set_earlier_record_aside(folder.path()));
  for (const char* session : {"first", "second", "third"}) {
    write(folder / "record.h5", session);
    EXPECT_TRUE(set_earlier_record_aside(folder.path()));
    EXPECT_FALSE(std::filesystem::exists(folder / "record.h5"));
  }
  EXPECT_EQ(text_of(folder / "record_1.h5"), "first");
  EXPECT_EQ(text_of(folder / "record_2.h5"), "second");
  EXPECT_EQ(text_of(folder / "record_3.h5"), "third");
}

}  // namespace
}  // namespace palpate::physics
