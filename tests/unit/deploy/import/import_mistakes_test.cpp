// Bad images and bad command lines: each gives one line on stderr that says what and where, exit code 2, and leaves an
// older volume and the folder as they were.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "tests/support/image/run_importer.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/image/small_images.h"

namespace palpate::test {
namespace {

struct Case {
  std::string name;
  std::string file;
  Bytes bytes;
  std::vector<std::string> options;
  std::string says;
};

void PrintTo(const Case& each, std::ostream* to) { *to << each.name; }

Bytes changed(Bytes text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

template <class T>
Bytes with(Bytes bytes, std::size_t at, T value) {
  put(bytes, at, value);
  return bytes;
}

Bytes without_end(const Bytes& bytes, std::size_t n) { return bytes.substr(0, bytes.size() - n); }

std::vector<Case> inv3_cases() {
  const Bytes whole = inv3(), tar = tarred(project_entries());
  const auto lacking = [](std::size_t entry) {
    NamedBytes entries = project_entries();
    entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(entry));
    return gzipped(tarred(entries));
  };
  const auto cells = [](const Bytes& bytes) {
    NamedBytes entries = project_entries();
    entries[1].second = bytes;
    return gzipped(tarred(entries));
  };
  const auto plist = [](const Bytes& bytes) {
    NamedBytes entries = project_entries();
    entries[0].second = bytes;
    return gzipped(tarred(entries));
  };
  const Bytes picture_bytes = bytes_of(picture());
  std::string deep = "<plist><dict><key>a</key>";
  for (int i = 0; i < 5000; ++i) deep += "<array>";
  for (int i = 0; i < 5000; ++i) deep += "</array>";
  return {{"Inv3IsEmpty", "a.inv3", "", {}, "is empty"},
          {"Inv3IsText", "a.inv3", "no archive", {}, "damaged"},
          {"Inv3GzipEndsInHeader", "a.inv3", first_bytes(whole, 12), {}, "damaged"},
          {"Inv3GzipEndsInData", "a.inv3", first_bytes(whole, whole.size() / 2), {}, "damaged"},
          {"Inv3GzipLacksItsSum", "a.inv3", without_end(whole, 4), {}, "damaged"},
          {"Inv3TarEndsInPlist", "a.inv3", gzipped(first_bytes(tar, 700)), {}, "damaged"},
          {"Inv3TarEndsInMatrix", "a.inv3", gzipped(first_bytes(tar, 512 + 1024 + 512 + 50)), {}, "damaged"},
          {"Inv3LacksPlist", "a.inv3", lacking(0), {}, "main.plist"},
          {"Inv3LacksMatrix", "a.inv3", lacking(1), {}, "matrix.dat: is not in the archive"},
          {"Inv3MatrixIsShort", "a.inv3", cells(without_end(picture_bytes, 2)), {}, "holds 118 bytes"},
          {"Inv3MatrixIsLong", "a.inv3", cells(picture_bytes + "x"), {}, "more bytes"},
          {"Inv3PlistIsEmpty", "a.inv3", plist(""), {}, "property list"},
          {"Inv3PlistEndsEarly", "a.inv3", plist(first_bytes(main_plist(), 200)), {}, "property list"},
          {"Inv3PlistIsDeep", "a.inv3", plist(deep + "</dict></plist>"), {}, "nested"},
          {"Inv3PlistLacksSpacing",
           "a.inv3",
           plist(changed(main_plist(), "spacing", "spices")),
           {},
           "lacks \"spacing\""},
          {"Inv3SpacingIsNan",
           "a.inv3",
           inv3({.spacing = "<real>nan</real><real>1</real><real>1</real>"}),
           {},
           "spacing"},
          {"Inv3SpacingIsZero",
           "a.inv3",
           inv3({.spacing = "<real>1</real><real>0</real><real>1</real>"}),
           {},
           "spacing"},
          {"Inv3SpacingIsText",
           "a.inv3",
           inv3({.spacing = "<real>a</real><real>0</real><real>1</real>"}),
           {},
           "not a number"},
          {"Inv3ShapeOfTwo",
           "a.inv3",
           inv3({.shape = "<integer>3</integer><integer>20</integer>"}),
           {},
           "three numbers"},
          {"Inv3ShapeIsAbsurd",
           "a.inv3",
           inv3({.shape = "<integer>1000</integer><integer>1000</integer><integer>1000</integer>"}),
           {},
           "1e9"},
          {"Inv3ShapeOverflows",
           "a.inv3",
           inv3({.shape =
                     "<integer>900000000</integer><integer>900000000</integer><integer>900000000</integer>"}),
           {},
           "1e9"},
          {"Inv3ShapeIsNegative",
           "a.inv3",
           inv3({.shape = "<integer>-3</integer><integer>4</integer><integer>5</integer>"}),
           {},
           "at least 1"},
          {"Inv3TypeIsUnknown", "a.inv3", inv3({.dtype = "complex64"}), {}, "complex64"}};
}

Bytes gzipped_nrrd() {
  const Bytes cells = bytes_of(picture());
  return changed(without_end(nrrd(), cells.size()), "encoding: raw", "encoding: gzip") + gzipped(cells);
}

std::vector<Case> library_cases() {
  const float not_a_number = std::numeric_limits<float>::quiet_NaN();
  const Bytes floats = bytes_of(std::vector<float>(60, not_a_number));
  Bytes nan_cells =
      with<std::int16_t>(with<std::int16_t>(first_bytes(nifti(), 352), 70, 16), 72, 32) + floats;
  return {
      {"NiftiIsShort", "a.nii", without_end(nifti(), 1), {}, "bytes of the "},
      {"NiftiEndsInHeader", "a.nii", first_bytes(nifti(), 200), {}, "not NIfTI-1"},
      {"NiftiGzipEnds", "a.nii.gz", without_end(gzipped(nifti()), 12), {}, "damaged"},
      {"NiftiIsText", "a.nii", Bytes(400, 'x'), {}, "not NIfTI-1"},
      {"NiftiIsAbsurd",
       "a.nii",
       with<std::int16_t>(with<std::int16_t>(with<std::int16_t>(nifti(), 42, 30000), 44, 30000), 46, 30000),
       {},
       "1e9"},
      {"NiftiIsNearlyAbsurd",
       "a.nii",
       with<std::int16_t>(with<std::int16_t>(with<std::int16_t>(nifti(), 42, 990), 44, 1000), 46, 1000),
       {},
       "bytes of the"},
      {"NiftiIsNegative", "a.nii", with<std::int16_t>(nifti(), 42, -5), {}, "at least 1"},
      {"NiftiIsFlat", "a.nii", with<std::int16_t>(nifti(), 40, 2), {}, "2 axes"},
      {"NiftiHasTimes", "a.nii", with<std::int16_t>(with<std::int16_t>(nifti(), 40, 4), 48, 7), {}, "4 axes"},
      {"NiftiSpacingIsNan", "a.nii", with<float>(nifti(), 84, not_a_number), {}, "spacing"},
      {"NiftiSpacingIsZero", "a.nii", with<float>(nifti(), 88, 0.0f), {}, "spacing"},
      {"NiftiSpacingIsNegative", "a.nii", with<float>(nifti(), 80, -1.0f), {}, "spacing"},
      {"NiftiHoldsNan", "a.nii", nan_cells, {}, "60 of its values"},
      {"NrrdIsShort", "a.nrrd", without_end(nrrd(), 1), {}, "damaged"},
      {"NrrdIsText", "a.nrrd", "sizes", {}, "not NRRD"},
      {"NrrdSpacingIsNan", "a.nrrd", changed(nrrd(), "(0.5,0,0)", "(nan,0,0)"), {}, "spacing"},
      {"NrrdLacksSpacing",
       "a.nrrd",
       changed(nrrd(), "space directions: (0.5,0,0) (0,0.75,0) (0,0,2)\n", ""),
       {},
       "no spacing"},
      {"NrrdIsAbsurd", "a.nrrd", changed(nrrd(), "sizes: 5 4 3", "sizes: 5 400000 3000000"), {}, "1e9"},
      {"NrrdIsNearlyAbsurd",
       "a.nrrd",
       changed(nrrd(), "sizes: 5 4 3", "sizes: 900 1000 1000"),
       {},
       "damaged"},
      {"NrrdIsSkew", "a.nrrd", changed(nrrd(), "(0,0.75,0)", "(0.5,0.75,0)"), {}, "right angles"},
      {"NhdrLacksItsCells",
       "a.nhdr",
       changed(nrrd(), "endian: little", "data file: none.raw"),
       {},
       "missing"},
      {"MetaIsShort", "a.mha", without_end(meta_image(), 1), {}, "damaged"},
      {"MetaIsNoHeader", "a.mha", "NDims = 3", {}, "not a MetaImage"},
      {"MetaSpacingIsZero", "a.mha", changed(meta_image(), "0.5 0.75 2", "0.5 0 2"), {}, "spacing"},
      {"MetaSpacingIsNan", "a.mha", changed(meta_image(), "0.5 0.75 2", "0.5 nan 2"), {}, "spacing"},
      {"MetaLacksSpacing",
       "a.mha",
       changed(meta_image(), "ElementSpacing = 0.5 0.75 2\n", ""),
       {},
       "no spacing"},
      {"MetaIsAbsurd", "a.mha", changed(meta_image(), "5 4 3", "50000 40000 30000"), {}, "1e9"},
      {"MetaIsText",
       "a.mha",
       changed(meta_image(), "BinaryData = True", "BinaryData = False"),
       {},
       "cells are text"},
      {"MetaIsCompressedWithoutLength",
       "a.mha",
       changed(meta_image(), "CompressedData = False", "CompressedData = True"),
       {},
       "CompressedDataSize"},
      {"NrrdGzipIsShort", "a.nrrd", without_end(gzipped_nrrd(), 12), {}, "damaged"},
      {"MetaIsCompressedNonsense",
       "a.mha",
       changed(meta_image(), "CompressedData = False", "CompressedDataSize = 100\nCompressedData = True"),
       {},
       "damaged"},
      {"MetaTypeIsUnknown", "a.mha", changed(meta_image(), "MET_SHORT", "MET_STRING"), {}, "met_string"},
      {"MetaIsNearlyAbsurd", "a.mha", changed(meta_image(), "5 4 3", "900 1000 1000"), {}, "damaged"},
      {"MetaHasColours",
       "a.mha",
       changed(meta_image(), "DimSize", "ElementNumberOfChannels = 3\nDimSize") + bytes_of(picture()) +
           bytes_of(picture()),
       {},
       "several values"},
      {"MhdLacksItsCells", "a.mhd", changed(meta_image(), "LOCAL", "none.raw"), {}, "missing"},
      {"MhdListsFiles", "a.mhd", changed(meta_image(), "LOCAL", "LIST"), {}, "list of files"}};
}

std::vector<Case> raw_cases() {
  const Bytes cells = bytes_of(picture());
  const auto options = [](const std::string& size, const std::string& spacing,
                          const std::string& type = "int16") {
    return std::vector<std::string>{"--size", size, "--spacing-mm", spacing, "--type", type};
  };
  return {
      {"RawIsShort", "a.raw", without_end(cells, 1), options("5,4,3", "1,1,1"), "holds 119 bytes"},
      {"RawIsLong", "a.raw", cells + "x", options("5,4,3", "1,1,1"), "more bytes"},
      {"RawOfOtherType", "a.raw", cells, options("5,4,3", "1,1,1", "float32"), "holds 120 bytes"},
      {"RawTellsNoShape", "a.raw", cells, {}, "--size"},
      {"RawSpacingIsNan", "a.raw", cells, options("5,4,3", "1,nan,1"), "spacing"},
      {"RawSpacingIsZero", "a.raw", cells, options("5,4,3", "1,0,1"), "spacing"},
      {"RawSpacingIsNegative", "a.raw", cells, options("5,4,3", "1,1,-1"), "spacing"},
      {"RawIsAbsurd", "a.raw", cells, options("1000,1000,1000", "1,1,1"), "1e9"},
      {"RawOverflows", "a.raw", cells, options("9000000000000,9000000000000,9", "1,1,1"), "1e9"},
      {"RawIsNegative", "a.raw", cells, options("-5,4,3", "1,1,1"), "at least 1"},
      {"RawIsNearlyAbsurd", "a.raw.gz", gzipped(cells), options("990,1000,1000", "1,1,1"), "holds 120 bytes"},
      {"RawGzipEnds", "a.raw.gz", without_end(gzipped(cells), 12), options("5,4,3", "1,1,1"), "damaged"},
      {"InrSaysAnotherSize", "a.inr", inr(), options("5,4,2", "0.5,0.75,2"), "5,4,3 would be right"},
      {"InrSaysAnotherSpacing", "a.inr", inr(), options("5,4,3", "0.5,0.75,3"), "0.5,0.75,2 would be right"},
      {"InrSaysAnotherType", "a.inr", inr(), options("5,4,3", "0.5,0.75,2", "uint8"), "int16 would be right"},
      {"InrHeaderEnds", "a.inr", first_bytes(inr(), 100), {}, "does not end"},
      {"InrIsShort", "a.inr", without_end(inr(), 1), {}, "holds 119 bytes"},
      {"InrIsAbsurd",
       "a.inr",
       changed(changed(inr(), "XDIM=5\nYDIM=4\n", "XDIM=50000\nYDIM=90000\n"), "\n\n\n\n\n\n\n\n\n", "\n"),
       {},
       "1e9"},
      {"InrHasNoNumber", "a.inr", changed(inr(), "VX=0.5", "VX=a.b"), {}, "VX"},
      {"InrWithoutHeaderOrShape", "a.inr", cells, {}, "--size"}};
}

std::vector<Case> command_cases() {
  return {{"KindIsUnknown", "a.jpeg", Bytes(500, 'x'), {}, "no known kind"},
          {"NoEnding", "image", "xyz", {}, "no known kind"},
          {"SizeOfNifti", "a.nii", nifti(), {"--size", "5,4,3"}, "tells its own"},
          {"PartitionIsZero", "a.nii", nifti(), {"--partition", "5,0,3"}, "at least 1"},
          {"PartitionIsAbsurd", "a.nii", nifti(), {"--partition", "1000,1000,1000"}, "1e9"},
          {"PartitionOfTwo", "a.nii", nifti(), {"--partition", "5,4"}, "--partition"},
          {"PartitionIsText", "a.nii", nifti(), {"--partition", "a,b,c"}, "--partition"},
          {"TransferIsUnknown", "a.nii", nifti(), {"--transfer", "rainbow"}, "rainbow"},
          {"TypeIsUnknown", "a.raw", "x", {"--type", "bits"}, "bits"},
          {"OptionIsUnknown", "a.nii", nifti(), {"--colour"}, "--colour"}};
}

class ImportMistakes : public testing::TestWithParam<Case> {};

TEST_P(ImportMistakes, GiveOneLineAndLeaveEverythingAsItWas) {
  const Case& each = GetParam();
  const ScratchFolder folder;
  write_file(folder / each.file, each.bytes);
  write_file(folder / "old.h5", "an older volume");
  std::vector<std::string> arguments = {folder / each.file, "--out", folder / "old.h5"};
  arguments.insert(arguments.end(), each.options.begin(), each.options.end());
  const Outcome outcome = run_importer(arguments);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_THAT(outcome.err, testing::HasSubstr(each.says));
  EXPECT_THAT(outcome.err, testing::HasSubstr("; "));
  EXPECT_EQ(file_bytes(folder / "old.h5"), "an older volume");
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    names.push_back(entry.path().filename());
  EXPECT_THAT(names, testing::UnorderedElementsAre(each.file, "old.h5"));
}

const auto name_of = [](const auto& each) { return each.param.name; };
INSTANTIATE_TEST_SUITE_P(Inv3, ImportMistakes, testing::ValuesIn(inv3_cases()), name_of);
INSTANTIATE_TEST_SUITE_P(Library, ImportMistakes, testing::ValuesIn(library_cases()), name_of);
INSTANTIATE_TEST_SUITE_P(Raw, ImportMistakes, testing::ValuesIn(raw_cases()), name_of);
INSTANTIATE_TEST_SUITE_P(Command, ImportMistakes, testing::ValuesIn(command_cases()), name_of);

struct Place {
  std::string name, image, out, says;
};

class ImportPlaces : public testing::TestWithParam<Place> {};

TEST_P(ImportPlaces, ThatCannotBeUsedAreNamed) {
  const ScratchFolder folder;
  write_file(folder / "a.nii", nifti());
  const auto placed = [&](const std::string& name) { return name.starts_with("/") ? name : folder / name; };
  const Outcome outcome = run_importer({placed(GetParam().image), "--out", placed(GetParam().out)});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_THAT(outcome.err, testing::HasSubstr(GetParam().says));
  EXPECT_EQ(file_bytes(folder / "a.nii"), nifti());
}

INSTANTIATE_TEST_SUITE_P(
    All, ImportPlaces,
    testing::Values(Place{"ImageIsMissing", "none.nii", "v.h5", "no such file"},
                    Place{"OutputFoldersAreMissing", "a.nii", "none/none/v.h5", "no folder"},
                    Place{"OutputIsAFolder", "a.nii", "", "is a folder"},
                    Place{"OutputFolderIsAFile", "a.nii", "a.nii/v.h5", "no folder"},
                    Place{"OutputIsUnwritable", "a.nii", "/proc/v.h5", "cannot be written"},
                    Place{"OutputIsTheImage", "a.nii", "a.nii", "the image itself"},
                    Place{"ImageIsADevice", "/dev/null", "v.h5", "neither a file"}),
    [](const auto& each) { return each.param.name; });

TEST(ImportOutput, HasItsFolderMade) {
  const ScratchFolder folder;
  write_file(folder / "a.nii", nifti());
  EXPECT_EQ(run_importer({folder / "a.nii", "--out", folder / "data/v.h5"}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "data/v.h5"));
}

TEST(ImportMistakes, NothingGivenIsAMistake) {
  const Outcome outcome = run_importer({});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

}  // namespace
}  // namespace palpate::test
