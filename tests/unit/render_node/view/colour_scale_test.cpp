#include "render_node/view/colour_scale.h"

#include <gtest/gtest.h>

#include <limits>

namespace palpate::render {
namespace {

TEST(ColourScale, IsRoundAndOnlyGrows) {
  ColourScale scale;
  EXPECT_EQ(scale.words(), "1 mm");
  scale.see(0.5e-3);
  EXPECT_EQ(scale.words(), "1 mm") << "a dent that nobody sees";
  scale.see(1.2e-3);
  EXPECT_EQ(scale.words(), "2 mm");
  scale.see(7e-3);
  EXPECT_EQ(scale.words(), "10 mm");
  EXPECT_GE(scale.most(), 7e-3);
  scale.see(3e-3);
  EXPECT_EQ(scale.words(), "10 mm");
  for (double way = 1e-3; way < 10; way *= 1.07) {
    scale.see(way);
    EXPECT_GE(scale.most(), way * (1 - 2e-6));
  }
}

TEST(ColourScale, BeginsAnewWithAnotherKind) {
  ColourScale scale;
  scale.see(7e-3);
  scale.show(ColourKind::strain);
  EXPECT_EQ(scale.words(), "1 %");
  scale.see(0.13);
  EXPECT_EQ(scale.words(), "20 %");
  scale.see(static_cast<double>(0.2F));
  scale.show(ColourKind::strain);
  EXPECT_EQ(scale.words(), "20 %");
  scale.show(ColourKind::stress);
  EXPECT_EQ(scale.words(), "0.1 kPa");
  scale.see(4321);
  EXPECT_EQ(scale.words(), "5 kPa");
  EXPECT_STREQ(scale.heading(), "stress (von Mises)");
  scale.show(ColourKind::pressure);
  EXPECT_EQ(scale.words(), "0.1 kPa");
  EXPECT_STREQ(scale.heading(), "pressure");
  scale.show(ColourKind::awake);
  scale.see(1);
  EXPECT_EQ(scale.words(), "awake");
  EXPECT_STREQ(scale.least_words(), "asleep");
  EXPECT_EQ(scale.most(), 1);
}

TEST(ColourScale, HearsNothingOfWhatIsNotANumber) {
  ColourScale scale;
  scale.see(std::numeric_limits<double>::quiet_NaN());
  scale.see(std::numeric_limits<double>::infinity());
  EXPECT_EQ(scale.words(), "1 mm");
}

}  // namespace
}  // namespace palpate::render
