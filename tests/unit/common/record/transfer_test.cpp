#include <gtest/gtest.h>

#include "common/record/volume.h"

namespace palpate {
namespace {

std::uint32_t alpha(std::uint32_t colour) { return colour >> 24; }
int channel(std::uint32_t colour, unsigned which) { return static_cast<int>(colour >> (8 * which) & 255u); }

TEST(Transfer, IsLinearBetweenPointsAndConstantBeyond) {
  const std::vector<TransferPoint> transfer = {{0, {0, 0, 1, 0}}, {100, {1, 0.5, 0, 1}}};
  EXPECT_EQ(rgba_of(transfer, -5), 0x00FF0000u);  // blue, clear
  EXPECT_EQ(rgba_of(transfer, 0), 0x00FF0000u);
  EXPECT_EQ(rgba_of(transfer, 50), 0x80804080u);   // halfway
  EXPECT_EQ(rgba_of(transfer, 100), 0xFF0080FFu);  // red and half green, opaque
  EXPECT_EQ(rgba_of(transfer, 1e6), 0xFF0080FFu);
}

TEST(Transfer, PointsAtOneIntensityMakeAStep) {
  const std::vector<TransferPoint> transfer = {
      {0, {0, 0, 0, 0}}, {10, {0, 0, 0, 0}}, {10, {1, 1, 1, 1}}, {20, {1, 1, 1, 1}}};
  EXPECT_EQ(rgba_of(transfer, 9.999), 0u);
  EXPECT_EQ(rgba_of(transfer, 10), 0xFFFFFFFFu);
}

TEST(Transfer, OfCtShowsFatYellowishMuscleReddishAndBoneWhite) {
  const auto transfer = default_transfer(-1024, 2986);
  EXPECT_EQ(alpha(rgba_of(transfer, -1000)), 0u);
  EXPECT_EQ(alpha(rgba_of(transfer, -90)), 255u);
  const auto fat = rgba_of(transfer, -90), muscle = rgba_of(transfer, 55), bone = rgba_of(transfer, 1500);
  EXPECT_GT(channel(fat, 1), channel(fat, 2) + 30);             // yellowish: more green than blue
  EXPECT_GT(10 * channel(muscle, 0), 14 * channel(muscle, 1));  // reddish
  EXPECT_GT(channel(bone, 2), 230);                             // white
}

TEST(Transfer, OfOtherImagesIsGrey) {
  for (const auto& transfer : {default_transfer(0, 255), default_transfer(-1, 1), default_transfer(7, 7)}) {
    ASSERT_EQ(transfer.size(), 2u);
    EXPECT_LT(transfer[0].intensity, transfer[1].intensity);
    EXPECT_EQ(rgba_of(transfer, transfer[1].intensity), 0xFFFFFFFFu);
    EXPECT_EQ(rgba_of(transfer, transfer[0].intensity), 0u);
  }
}

}  // namespace
}  // namespace palpate
