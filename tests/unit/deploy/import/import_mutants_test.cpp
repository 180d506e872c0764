// Damaged images of every format: the importer ends by itself, with a line where it refuses, and within the
// memory it is given.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "tests/support/guarded_run.h"
#include "tests/support/image/bytes.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/image/small_images.h"
#include "tests/support/mutate.h"

namespace palpate::test {
namespace {

namespace fs = std::filesystem;
constexpr std::uint64_t n_mutants = 200, first_seed = 1;
constexpr double limit_GB = 0.5;

std::string importer() {
  const char* folder = std::getenv("PALPATE_BIN");
  return std::string(folder == nullptr ? "." : folder) + "/palpate-import";
}

/// An image of so many files; the first is damaged.
struct Image {
  std::string name;
  std::vector<std::pair<std::string, Bytes>> files;
  std::vector<std::string> options;
  std::size_t reach = SIZE_MAX;  // how far into the file it is damaged: headers more than cells
};

void PrintTo(const Image& image, std::ostream* to) { *to << image.name; }

std::vector<Image> images() {
  const Bytes cells = bytes_of(picture());
  const std::vector<std::string> raw = {"--size", "5,4,3", "--spacing-mm", "0.5,0.75,2", "--type", "int16"};
  std::vector<std::pair<std::string, Bytes>> slices;
  for (int k = 0; k < nz; ++k)
    slices.emplace_back("scan/" + std::to_string(k) + ".dcm", dicom({.k = k, .z_mm = 10.0 + 2 * k}));
  Bytes detached = meta_image();
  detached.resize(detached.size() - cells.size());
  detached.replace(detached.find("LOCAL"), 5, "a.raw");
  return {{"Inv3", {{"a.inv3", inv3()}}, {}, SIZE_MAX},
          {"Inv3Unpacked", {{"a.inv3", tarred(project_entries())}}, {}, SIZE_MAX},
          {"Nifti", {{"a.nii", nifti()}}, {}, 360},
          {"NiftiGzipped", {{"a.nii.gz", gzipped(nifti())}}, {}, SIZE_MAX},
          {"Nrrd", {{"a.nrrd", nrrd()}}, {}, SIZE_MAX},
          {"Meta", {{"a.mha", meta_image()}}, {}, SIZE_MAX},
          {"MetaDetached", {{"a.mhd", detached}, {"a.raw", cells}}, {}, SIZE_MAX},
          {"Inr", {{"a.inr", inr()}}, {}, SIZE_MAX},
          {"Raw", {{"a.raw", cells}}, raw, SIZE_MAX},
          {"RawGzipped", {{"a.raw.gz", gzipped(cells)}}, raw, SIZE_MAX},
          {"Dicom", slices, {}, SIZE_MAX}};
}

class ImportMutants : public testing::TestWithParam<Image> {};

TEST_P(ImportMutants, EndByThemselvesWithinTheirMemory) {
  const ScratchFolder folder;
  const Image& image = GetParam();
  for (const auto& [name, bytes] : image.files) {
    fs::create_directories(fs::path(folder / name).parent_path());
    write_file(folder / name, bytes);
  }
  const std::string damaged = folder / image.files[0].first, out = folder / "v.h5";
  const std::string input = image.name == "Dicom" ? folder / "scan" : damaged;
  std::vector<std::string> words = {
      importer(), input, "--out", out, "--memory-limit", std::to_string(limit_GB)};
  words.insert(words.end(), image.options.begin(), image.options.end());
  const Guarded whole = run_guarded(words, folder / "log");
  ASSERT_EQ(whole.code, 0) << whole.text;
  int refused = 0;
  for (std::uint64_t seed = first_seed; seed < first_seed + n_mutants; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    write_file(damaged, mutant(image.files[0].second, seed, image.reach));
    fs::remove(out);
    const Guarded run = run_guarded(words, folder / "log");
    EXPECT_FALSE(run.hung);
    EXPECT_THAT(run.code, testing::AnyOf(0, 2)) << run.text;
    EXPECT_LT(static_cast<double>(run.peak_bytes), 1e9 * limit_GB);
    EXPECT_EQ(fs::exists(out), run.code == 0);
    EXPECT_FALSE(fs::exists(out + ".part"));
    if (run.code == 0) continue;
    ++refused;
    EXPECT_EQ(std::count(run.text.begin(), run.text.end(), '\n'), 1) << run.text;
    EXPECT_THAT(run.text, testing::HasSubstr("; ")) << "says what would be right";
  }
  RecordProperty("refused", refused);
}

INSTANTIATE_TEST_SUITE_P(Formats, ImportMutants, testing::ValuesIn(images()),
                         [](const auto& each) { return each.param.name; });

struct Huge {
  std::string name;
  std::string file;
  Bytes bytes;
  std::vector<std::string> options;
};

void PrintTo(const Huge& huge, std::ostream* to) { *to << huge.name; }

class ImportCost : public testing::TestWithParam<Huge> {};

// 900 million cells: fewer than the format takes, more than the limit. Nothing of them is there: the cost
// comes first.
TEST_P(ImportCost, IsDeclaredBeforeMemoryIsTaken) {
  const ScratchFolder folder;
  const Huge& huge = GetParam();
  std::vector<std::string> words = {importer(), "--out", folder / "v.h5", "--memory-limit", "2"};
  if (!huge.file.empty()) {
    write_file(folder / huge.file, huge.bytes);
    words.push_back(folder / huge.file);
  }
  words.insert(words.end(), huge.options.begin(), huge.options.end());
  const Guarded run = run_guarded(words, folder / "log");
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.text,
              testing::AllOf(testing::HasSubstr("900 million cells take some"),
                             testing::HasSubstr("2.0 GB are allowed"), testing::HasSubstr("--memory-limit")));
  EXPECT_EQ(std::count(run.text.begin(), run.text.end(), '\n'), 1) << run.text;
  EXPECT_LT(static_cast<double>(run.peak_bytes), 0.2e9);
  EXPECT_FALSE(fs::exists(folder / "v.h5"));
}

std::vector<Huge> huge() {
  Bytes large = inr();
  for (const auto& [from, to] :
       {std::pair("XDIM=5", "XDIM=1000"), std::pair("YDIM=4", "YDIM=1000"), std::pair("ZDIM=3", "ZDIM=900")})
    large.replace(large.find(from), 6, to);
  large.erase(large.find("##}") - 8, 8);  // of the padding: a header is 256 bytes
  const std::string integers = "<integer>900</integer><integer>1000</integer><integer>1000</integer>";
  return {{"Inv3", "a.inv3", inv3({.shape = integers}), {}},
          {"Raw",
           "a.raw",
           Bytes(64, '\1'),
           {"--size", "1000,1000,900", "--spacing-mm", "1,1,1", "--type", "int16"}},
          {"Phantom", "", "", {"--phantom", "aneurysm", "--size", "1000,1000,900"}},
          {"Inr", "a.inr", large, {}},
          {"Partition", "a.inr", inr(), {"--partition", "1000,1000,900"}}};
}

INSTANTIATE_TEST_SUITE_P(Images, ImportCost, testing::ValuesIn(huge()),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace palpate::test
