// A volume file may come from anybody: each spoilt one gives one line that names the file, never a crash.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "common/error/error.h"
#include "common/record/hdf5_file.h"
#include "common/record/volume.h"
#include "tests/support/image/bytes.h"
#include "tests/support/image/scratch_folder.h"

namespace palpate {
namespace {

using test::ScratchFolder;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// What is wrong with the file: changes to a sound one, made while it is written.
struct Parts {
  std::vector<std::uint64_t> shape = {2, 3, 4};
  std::vector<float> intensity = std::vector<float>(24, 1.0f);
  std::vector<std::uint64_t> transfer_shape = {2, 5};
  std::vector<double> transfer = {0, 0, 0, 0, 0, 1, 1, 1, 1, 1};
  std::map<std::string, std::vector<double>> numbers = {{"version", {1}},
                                                        {"partition", {4, 3, 2}},
                                                        {"spacing_m", {1e-3, 1e-3, 1e-3}},
                                                        {"origin_m", {0, 0, 0}},
                                                        {"orientation_lps", {1, 0, 0, 0, 1, 0, 0, 0, 1}},
                                                        {"source_size", {4, 3, 2}}};
  std::map<std::string, std::string> texts = {
      {"format", "palpate volume"}, {"source", "a.nii"}, {"source_checksum", "ff"}};
};

void write_parts(const Parts& parts, const std::string& path) {
  Hdf5File file(path, Hdf5File::Mode::create);
  for (const auto& [name, values] : parts.numbers) file.set_numbers(name, values);
  for (const auto& [name, value] : parts.texts) file.set_text(name, value);
  if (!parts.shape.empty()) file.write("/intensity", parts.shape, parts.intensity.data());
  if (!parts.transfer_shape.empty()) file.write("/transfer", parts.transfer_shape, parts.transfer.data());
}

std::string complaint_of(const std::string& path) {
  try {
    static_cast<void>(read_volume(path));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no complaint";
}

struct Case {
  std::string name;
  std::function<void(Parts&)> spoil;
  std::string says;
};

void PrintTo(const Case& each, std::ostream* to) { *to << each.name; }

std::vector<Case> cases() {
  const auto number = [](std::string name, std::vector<double> values) {
    return [=](Parts& parts) { parts.numbers[name] = values; };
  };
  const auto without = [](std::string name) {
    return [=](Parts& parts) { parts.numbers.erase(name), parts.texts.erase(name); };
  };
  const auto text = [](std::string name, std::string value) {
    return [=](Parts& parts) { parts.numbers.erase(name), parts.texts[name] = value; };
  };
  return {
      {"NoFormat", without("format"), "not a palpate volume"},
      {"OtherFormat", text("format", "something else"), "not a palpate volume"},
      {"OtherVersion", number("version", {2}), "another version"},
      {"NoVersion", without("version"), "version"},
      {"VersionIsText", text("version", "1"), "not made of numbers"},
      {"NoSpacing", without("spacing_m"), "spacing_m"},
      {"SpacingIsNan", number("spacing_m", {1e-3, nan, 1e-3}), "spacing"},
      {"SpacingIsZero", number("spacing_m", {1e-3, 0, 1e-3}), "spacing"},
      {"SpacingIsNegative", number("spacing_m", {-1e-3, 1e-3, 1e-3}), "spacing"},
      {"SpacingOfTwo", number("spacing_m", {1e-3, 1e-3}), "3 numbers"},
      {"SpacingIsText", text("spacing_m", "1 mm"), "not made of numbers"},
      {"OriginIsInfinite", number("origin_m", {0, 1 / 0.0, 0}), "origin"},
      {"OrientationIsFlat", number("orientation_lps", {1, 1, 0, 0, 0, 0, 0, 0, 1}), "orientation"},
      {"OrientationIsNan", number("orientation_lps", {nan, 0, 0, 0, 1, 0, 0, 0, 1}), "orientation"},
      {"OrientationOfThree", number("orientation_lps", {1, 0, 0}), "9 numbers"},
      {"NoSource", without("source"), "source"},
      {"ChecksumIsNotHexadecimal", text("source_checksum", "xyz"), "source_checksum"},
      {"ChecksumIsTooLong", text("source_checksum", "12345678901234567"), "source_checksum"},
      {"SourceSizeIsNan", number("source_size", {nan, 3, 2}), "source_size"},
      {"SourceSizeIsNegative", number("source_size", {-4, 3, 2}), "at least 1"},
      {"PartitionDoesNotMatch", number("partition", {4, 3, 3}), "partition"},
      {"PartitionIsAbsurd", number("partition", {1e300, 3, 2}), "partition"},
      {"NoIntensity", [](Parts& p) { p.shape.clear(); }, "no sound dataset /intensity"},
      {"IntensityIsFlat",
       [](Parts& p) {
         p.shape = {6, 4};
       },
       "three axes"},
      {"IntensityIsEmpty",
       [](Parts& p) {
         p.shape = {0, 3, 4};
       },
       "at least 1"},
      {"IntensityIsNan", [](Parts& p) { p.intensity[7] = std::numeric_limits<float>::quiet_NaN(); },
       "not finite"},
      {"NoTransfer", [](Parts& p) { p.transfer_shape.clear(); }, "no sound dataset /transfer"},
      {"TransferIsFlat", [](Parts& p) { p.transfer_shape = {10}; }, "transfer"},
      {"TransferOfOnePoint",
       [](Parts& p) {
         p.transfer_shape = {1, 5};
       },
       "two points"},
      {"TransferIsNotSorted", [](Parts& p) { p.transfer[0] = 2; }, "sorted"},
      {"TransferIsNan", [](Parts& p) { p.transfer[5] = nan; }, "sorted"},
      {"TransferIsTooBright", [](Parts& p) { p.transfer[6] = 1.5; }, "0..1"},
  };
}

class HostileVolume : public testing::TestWithParam<Case> {};

TEST_P(HostileVolume, GivesOneLineThatNamesTheFile) {
  const ScratchFolder folder;
  const std::string path = folder / "v.h5";
  Parts parts;
  write_parts(parts, path);
  ASSERT_EQ(complaint_of(path), "no complaint");
  GetParam().spoil(parts);
  write_parts(parts, path);
  const std::string complaint = complaint_of(path);
  EXPECT_THAT(complaint, testing::StartsWith(path + ": "));
  EXPECT_THAT(complaint, testing::HasSubstr(GetParam().says));
  EXPECT_THAT(complaint, testing::HasSubstr("; "));
  EXPECT_EQ(std::count(complaint.begin(), complaint.end(), '\n'), 0);
}

INSTANTIATE_TEST_SUITE_P(Spoilt, HostileVolume, testing::ValuesIn(cases()),
                         [](const auto& each) { return each.param.name; });

// The shape in the file is made to claim billions of cells, of which nothing is in the file.
TEST(HostileVolume, AbsurdSizesAreRefusedBeforeMemoryIsTaken) {
  const ScratchFolder folder;
  const std::string path = folder / "v.h5";
  using Shape = std::vector<std::uint64_t>;
  for (const auto& [shape, says] : {std::pair{Shape{40'000, 40'000, 40'000}, "1e9"},
                                    std::pair{Shape{~0ull, ~0ull, ~0ull}, "no sound dataset"},
                                    std::pair{Shape{990, 1000, 1000}, "less than its shape"}}) {
    Parts parts;
    const auto claim = [&shape = shape](std::size_t axis) {
      return static_cast<double>(std::min<std::uint64_t>(shape[axis], 1000));
    };
    parts.numbers["partition"] = {claim(2), claim(1), claim(0)};
    write_parts(parts, path);
    test::Bytes bytes = test::file_bytes(path);
    int found = 0;  // the shape and the largest shape
    for (auto at = bytes.find(test::bytes_of(parts.shape)); at != std::string::npos;
         at = bytes.find(test::bytes_of(parts.shape)), ++found)
      bytes.replace(at, 24, test::bytes_of(shape));
    ASSERT_EQ(found, 2);
    test::write_file(path, bytes);
    EXPECT_THAT(complaint_of(path), testing::HasSubstr(says));
  }
}

TEST(HostileVolume, TruncatedAnywhereIsRefused) {
  const ScratchFolder folder;
  Volume volume;
  volume.size = volume.source_size = {40, 40, 40};
  volume.spacing = {1e-3, 1e-3, 1e-3};
  for (int i = 0; i < 64'000; ++i) volume.intensity.push_back(static_cast<float>(i * 7919 % 3001));
  volume.transfer = grey_transfer(0, 3000);
  write_volume(volume, folder / "whole.h5");
  const std::string bytes = test::file_bytes(folder / "whole.h5");
  for (std::size_t part = 0; part < 60; ++part) {
    test::write_file(folder / "part.h5", test::first_bytes(bytes, bytes.size() * part / 60));
    EXPECT_NE(complaint_of(folder / "part.h5"), "no complaint") << part << " of 60";
  }
}

TEST(HostileVolume, MissingAndForeignFilesAreNamed) {
  const ScratchFolder folder;
  EXPECT_THAT(complaint_of(folder / "none.h5"), testing::HasSubstr("no such file"));
  test::write_file(folder / "text.h5", "just text");
  EXPECT_THAT(complaint_of(folder / "text.h5"), testing::HasSubstr("not an HDF5 file"));
  EXPECT_THAT(complaint_of(folder.path()), testing::StartsWith(folder.path()));
}

}  // namespace
}  // namespace palpate
