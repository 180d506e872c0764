// The head CT of Debian's package invesalius-examples, against the bone mask that the package itself carries.
#include <gtest/gtest.h>

#include <filesystem>

#include "common/record/volume.h"
#include "tests/support/image/bytes.h"
#include "tests/support/image/run_importer.h"
#include "tests/support/image/scratch_folder.h"

namespace palpate::test {
namespace {

const std::string head = "/usr/share/doc/invesalius-examples/examples/Cranium.inv3";

/// The mask has one slice, row and column in front that belong to no cell.
bool in_mask(const Bytes& mask, int i, int j, int k) {
  const std::size_t at = (static_cast<std::size_t>(k + 1) * 257 + static_cast<std::size_t>(j + 1)) * 257 +
                         static_cast<std::size_t>(i + 1);
  return mask[at] != 0;
}

TEST(ImportHead, BoneIsThePackagesOwnMaskOnEveryVoxel) {
  ASSERT_TRUE(std::filesystem::exists(head)) << "install the Debian package invesalius-examples";
  const ScratchFolder folder;
  const Outcome outcome = run_importer({head, "--out", folder / "head.h5"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Volume volume = read_volume(folder / "head.h5");
  ASSERT_EQ(volume.size, (std::array<int, 3>{256, 256, 108}));
  EXPECT_DOUBLE_EQ(volume.spacing[0], 0.9570312e-3);
  EXPECT_DOUBLE_EQ(volume.spacing[1], 0.9570312e-3);
  EXPECT_DOUBLE_EQ(volume.spacing[2], 1.5e-3);
  const Bytes mask = entry_of_tar_gz(head, "mask_0.dat");
  ASSERT_EQ(mask.size(), std::size_t{109} * 257 * 257);
  int bone = 0, different = 0;
  for (int k = 0; k < 108; ++k)
    for (int j = 0; j < 256; ++j)
      for (int i = 0; i < 256; ++i) {
        const bool is_bone = volume.at(i, j, k) >= 226 && volume.at(i, j, k) <= 3071;
        bone += is_bone;
        different += is_bone != in_mask(mask, i, j, k);
      }
  EXPECT_EQ(bone, 475'759);
  EXPECT_EQ(different, 0);
}

}  // namespace
}  // namespace palpate::test
