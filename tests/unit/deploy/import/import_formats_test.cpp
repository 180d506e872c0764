// The same picture in every format comes out of palpate-import with the same cells.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/math/hash.h"
#include "common/record/volume.h"
#include "tests/support/image/run_importer.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/image/small_images.h"

namespace palpate::test {
namespace {

struct Case {
  std::string name;  // of the test
  std::string file;  // name it is given
  Bytes bytes;
  std::vector<std::string> options;
  std::optional<Eigen::Vector3d> orientation;  // diagonal; absent: unknown
  Eigen::Vector3d origin_mm = {0, 0, 0};
};

void PrintTo(const Case& each, std::ostream* to) { *to << each.name; }

std::vector<std::string> raw_options(std::vector<std::string> more = {}) {
  std::vector<std::string> options = {"--size", "5,4,3", "--spacing-mm", "0.5,0.75,2", "--type", "int16"};
  options.insert(options.end(), more.begin(), more.end());
  return options;
}

std::vector<Case> cases() {
  const Bytes cells = bytes_of(picture());
  const auto in_front = [&](const Bytes& image) { return image.substr(0, image.size() - cells.size()); };
  Bytes gzip_nrrd = in_front(nrrd());
  gzip_nrrd.replace(gzip_nrrd.find("encoding: raw"), 13, "encoding: gzip");
  Bytes zip_meta = in_front(meta_image());
  zip_meta.replace(zip_meta.find("CompressedData = False"), 22,
                   "CompressedData = True\nCompressedDataSize = " + std::to_string(gzipped(cells).size()));
  const Eigen::Vector3d lps(1, 1, 1), ras(-1, -1, 1), inv(1, -1, 1), at(1, 2, 3), nowhere(0, 0, 0);
  return {
      {"Nifti", "a.nii", nifti(), {}, ras, nowhere},
      {"NiftiGzipped", "a.nii.gz", gzipped(nifti()), {}, ras, nowhere},
      {"Nrrd", "a.nrrd", nrrd(), {}, lps, at},
      {"MetaImage", "a.mha", meta_image(), {}, lps, at},
      {"NrrdGzipped", "a.nrrd", gzip_nrrd + gzipped(cells), {}, lps, at},
      {"MetaImageCompressed", "a.mha", zip_meta + gzipped(cells), {}, lps, at},
      {"Raw", "a.raw", cells, raw_options(), {}, nowhere},
      {"RawGzipped", "A.RAW.GZ", gzipped(cells), raw_options(), {}, nowhere},
      {"RawWithHeader", "a.raw", "some header" + cells, raw_options({"--header", "11"}), {}, nowhere},
      {"Inr", "a.inr", inr(), {}, {}, nowhere},
      {"InrGzippedWithItsOptions", "a.inr.gz", gzipped(inr()), raw_options({"--header", "256"}), {}, nowhere},
      {"InrWithoutHeader", "a.inr", cells, raw_options(), {}, nowhere},
      {"InVesalius", "a.inv3", inv3(), {}, inv, nowhere},
      {"InVesaliusNotAxial", "a.inv3", inv3({.orientation = ""}), {}, {}, nowhere},
      {"InVesaliusNotGzipped", "a.inv3", tarred(project_entries()), {}, inv, nowhere}};
}

class ImportFormats : public testing::TestWithParam<Case> {};

TEST_P(ImportFormats, GiveSizeSpacingOrientationAndEveryValue) {
  const Case& each = GetParam();
  const ScratchFolder folder;
  const std::string image = folder / each.file, out = folder / "v.h5";
  write_file(image, each.bytes);
  std::vector<std::string> arguments = {image, "--out", out};
  arguments.insert(arguments.end(), each.options.begin(), each.options.end());
  const Outcome outcome = run_importer(arguments);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out, each.file +
                             ": 5 x 4 x 3 cells of 0.5 x 0.75 x 2 mm, intensity -1000 to 1328, written to " +
                             out + "\n");
  const Volume volume = read_volume(out);
  EXPECT_EQ(volume.size, (std::array<int, 3>{nx, ny, nz}));
  EXPECT_EQ(volume.source_size, volume.size);
  EXPECT_TRUE(volume.spacing.isApprox(Eigen::Vector3d(5e-4, 7.5e-4, 2e-3), 1e-14));
  EXPECT_TRUE((volume.origin - 1e-3 * each.origin_mm).isZero(1e-12));
  EXPECT_EQ(volume.source, each.file);
  EXPECT_EQ(volume.source_checksum, hash_text(each.bytes));
  ASSERT_EQ(volume.orientation.has_value(), each.orientation.has_value());
  if (each.orientation) {
    EXPECT_TRUE(volume.orientation->isApprox(each.orientation->asDiagonal().toDenseMatrix(), 1e-6));
  }
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) ASSERT_EQ(volume.at(i, j, k), value_at(i, j, k));
}

INSTANTIATE_TEST_SUITE_P(All, ImportFormats, testing::ValuesIn(cases()),
                         [](const auto& each) { return each.param.name; });

TEST(ImportFormats, DetachedHeadersFindTheirCells) {
  const ScratchFolder folder;
  const Bytes cells = bytes_of(picture());
  for (const auto& [file, whole, last, data] :
       {std::tuple{"a.mhd", meta_image(), "ElementDataFile = LOCAL\n", "ElementDataFile = cells.raw\n"},
        std::tuple{"a.nhdr", nrrd(), "\n\n", "\ndata file: cells.raw\n"}}) {
    Bytes header = whole.substr(0, whole.size() - cells.size());
    header = header.substr(0, header.size() - std::string(last).size()) + data;
    write_file(folder / file, header);
    write_file(folder / "cells.raw", cells);
    const Outcome outcome = run_importer({folder / file, "--out", folder / "v.h5"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Volume volume = read_volume(folder / "v.h5");
    EXPECT_EQ(volume.source_checksum, hash_text(header + cells));
    EXPECT_EQ(volume.at(4, 3, 2), value_at(4, 3, 2));
    EXPECT_EQ(volume.at(1, 0, 0), value_at(1, 0, 0));
  }
}

TEST(ImportFormats, BigEndianInrIsTurned) {
  const ScratchFolder folder;
  Bytes bytes = inr();
  bytes.replace(bytes.find("CPU=decm\n"), 9, "CPU=sun \n");
  bytes.replace(bytes.find("CPU=sun \n"), 9, "CPU=sun\n\n");
  for (std::size_t i = 256; i < bytes.size(); i += 2) std::swap(bytes[i], bytes[i + 1]);
  write_file(folder / "a.inr", bytes);
  ASSERT_EQ(run_importer({folder / "a.inr", "--out", folder / "v.h5"}).code, 0);
  EXPECT_EQ(read_volume(folder / "v.h5").at(3, 2, 1), value_at(3, 2, 1));
}

TEST(ImportFormats, RawCellsOfEachTypeAreUnderstood) {
  const ScratchFolder folder;
  const auto import = [&](const Bytes& cells, const std::string& type) {
    write_file(folder / "a.raw", cells);
    const Outcome outcome = run_importer({folder / "a.raw", "--out", folder / "v.h5", "--size", "2,2,1",
                                          "--spacing-mm", "1,1,1", "--type", type});
    EXPECT_EQ(outcome.err, "");
    return read_volume(folder / "v.h5").intensity;
  };
  EXPECT_EQ(import(bytes_of(std::vector<std::uint8_t>{0, 1, 200, 255}), "uint8"),
            (std::vector<float>{0, 1, 200, 255}));
  EXPECT_EQ(import(bytes_of(std::vector<std::int16_t>{-32768, -1, 0, 32767}), "int16"),
            (std::vector<float>{-32768, -1, 0, 32767}));
  EXPECT_EQ(import(bytes_of(std::vector<std::uint16_t>{0, 1, 32768, 65535}), "uint16"),
            (std::vector<float>{0, 1, 32768, 65535}));
  EXPECT_EQ(import(bytes_of(std::vector<float>{-1.5f, 0, 1e-7f, 3e38f}), "float32"),
            (std::vector<float>{-1.5f, 0, 1e-7f, 3e38f}));
}

}  // namespace
}  // namespace palpate::test
