#include "common/record/hdf5_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <stdexcept>

#include "tests/support/image/scratch_folder.h"

namespace palpate {
namespace {

using test::ScratchFolder;
using Mode = Hdf5File::Mode;

template <class T>
class Hdf5Numbers : public testing::Test {};
using Types =
    testing::Types<float, double, std::int16_t, std::uint8_t, std::int32_t, std::uint32_t, std::uint64_t>;
TYPED_TEST_SUITE(Hdf5Numbers, Types);

TYPED_TEST(Hdf5Numbers, ComeBackAsTheyWere) {
  const ScratchFolder folder;
  std::vector<TypeParam> values(50'000);  // large enough to be deflated for all but the narrowest
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<TypeParam>((i * 2654435761u) % 120);
  {
    Hdf5File file(folder / "a.h5", Mode::create);
    file.write("/deep/down/values", {50, 10, 100}, values.data());
    file.make_series<TypeParam>("/rows", {2});
    for (std::size_t i = 0; i < 300; ++i) file.append("/rows", &values[2 * i]);
  }
  const Hdf5File file(folder / "a.h5", Mode::read);
  EXPECT_EQ(file.shape("/deep/down/values"), (std::vector<std::uint64_t>{50, 10, 100}));
  EXPECT_EQ(file.read<TypeParam>("/deep/down/values"), values);
  EXPECT_EQ(file.shape("/rows"), (std::vector<std::uint64_t>{300, 2}));
  values.resize(600);
  EXPECT_EQ(file.read<TypeParam>("/rows"), values);
}

TEST(Hdf5File, KeepsAttributes) {
  const ScratchFolder folder;
  {
    Hdf5File file(folder / "a.h5", Mode::create);
    file.set_text("title", "before");
    file.set_text("title", "Höhe");
    file.set_text("nothing", "");
    file.set_numbers("numbers", {1.5, -2, 1e300});
    file.make_group("/a/b");
  }
  const Hdf5File file(folder / "a.h5", Mode::read);
  EXPECT_EQ(file.text("title"), "Höhe");
  EXPECT_EQ(file.text("nothing"), "");
  EXPECT_EQ(file.numbers("numbers"), (std::vector<double>{1.5, -2, 1e300}));
  EXPECT_TRUE(file.has_attribute("title"));
  EXPECT_FALSE(file.has_attribute("author"));
  EXPECT_TRUE(file.has("/a/b"));
  EXPECT_TRUE(file.has("/"));
  EXPECT_FALSE(file.has("/a/b/c/d"));
}

TEST(Hdf5File, DeflatesWhatIsLarge) {
  const ScratchFolder folder;
  const std::vector<float> zeros(1'000'000, 0.0f);
  {
    Hdf5File file(folder / "a.h5", Mode::create);
    file.write("/zeros", {100, 100, 100}, zeros.data());
  }
  EXPECT_LT(std::filesystem::file_size(folder / "a.h5"), 40'000u);
  EXPECT_EQ(Hdf5File(folder / "a.h5", Mode::read).read<float>("/zeros"), zeros);
}

TEST(Hdf5File, SaysWhichFileAndWhatIsWrong) {
  const ScratchFolder folder;
  const auto complaint = [&](const auto& act) {
    try {
      act();
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("no complaint");
  };
  const std::string path = folder / "a.h5";
  const auto says = [&](const std::string& words) {
    return testing::AllOf(testing::StartsWith(path), testing::HasSubstr(words));
  };
  EXPECT_THAT(complaint([&] { Hdf5File(path, Mode::read); }), says("no such file"));
  std::ofstream(path) << "not HDF5 at all";
  EXPECT_THAT(complaint([&] { Hdf5File(path, Mode::read); }), says("not an HDF5 file"));
  Hdf5File file(path, Mode::create);
  file.set_text("title", "t");
  EXPECT_THAT(complaint([&] { static_cast<void>(file.read<float>("/none")); }),
              says("no sound dataset /none"));
  EXPECT_THAT(complaint([&] { static_cast<void>(file.shape("/none")); }), says("no sound dataset /none"));
  EXPECT_THAT(complaint([&] { static_cast<void>(file.text("none")); }), says("no attribute none"));
  EXPECT_THAT(complaint([&] { static_cast<void>(file.numbers("title")); }), says("not made of numbers"));
  const float row = 1;
  EXPECT_THAT(complaint([&] { file.append("/none", &row); }), says("no series /none"));
  EXPECT_THAT(complaint([&] { Hdf5File((folder / "none") + "/a.h5", Mode::create); }),
              testing::HasSubstr("cannot be created"));
}

TEST(Hdf5File, ReadOnlyFilesRefuseWriting) {
  const ScratchFolder folder;
  const double one = 1;
  { Hdf5File(folder / "a.h5", Mode::create).write("/one", {1}, &one); }
  Hdf5File file(folder / "a.h5", Mode::read);
  EXPECT_THROW(file.write("/two", {1}, &one), std::runtime_error);
}

// A writer is killed in the middle of its work, some rows after its last flush.
TEST(Hdf5File, AKilledWriterLeavesWhatItFlushed) {
  const ScratchFolder folder;
  const std::string path = folder / "a.h5";
  constexpr std::uint64_t flushed = 5000;
  const pid_t child = fork();
  if (child == 0) {
    Hdf5File file(path, Mode::create);
    file.make_series<double>("/trace", {7});
    file.make_series<float>("/positions", {1000, 3});
    std::vector<double> row(7);
    std::vector<float> positions(3000);
    for (std::uint64_t i = 0; i < 3 * flushed; ++i) {
      std::fill(row.begin(), row.end(), static_cast<double>(i));
      file.append("/trace", row.data());
      if (i % 100 == 0) file.append("/positions", positions.data());
      if (i % 1000 == 0 && i <= flushed) file.flush();
      if (i > flushed + 700) std::raise(SIGKILL);
    }
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  const Hdf5File file(path, Mode::read);
  ASSERT_GE(file.shape("/trace")[0], flushed);
  ASSERT_GE(file.shape("/positions")[0], flushed / 100);
  const auto trace = file.read<double>("/trace");
  for (std::uint64_t i = 0; i < flushed; ++i) ASSERT_EQ(trace[7 * i + 3], static_cast<double>(i));
}

TEST(Hdf5File, ReadsNoMoreThanWasExpected) {
  const ScratchFolder folder;
  const std::string path = folder / "a.h5";
  Hdf5File file(path, Hdf5File::Mode::create);
  const std::vector<std::uint8_t> bytes{'t', 'e', 'x', 't', '!', '!'};
  file.write<std::uint8_t>("/rows", {3, 2}, bytes.data());
  EXPECT_EQ(file.read_text("/rows", 6), "text!!");
  EXPECT_THROW(static_cast<void>(file.read_text("/rows", 5)), std::runtime_error);
  EXPECT_EQ(file.read_rows<double>("/rows", 1, 2, 2).size(), 4u);
  EXPECT_THROW(static_cast<void>(file.read_rows<double>("/rows", 1, 2, 3)), std::runtime_error);
}

}  // namespace
}  // namespace palpate
