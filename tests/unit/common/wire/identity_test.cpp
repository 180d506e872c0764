// What a process says of itself, what strangers may say instead, and which differences are told to a person.

#include "common/wire/identity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace palpate {
namespace {

using testing::HasSubstr;

Identity sample() { return own_identity("physics", "scenes/head press.toml", 0xfeedbeef); }

TEST(Identity, ComesBackFromItsText) {
  const Identity own = sample();
  const auto read = identity_from(to_text(own));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->role, "physics");
  EXPECT_EQ(read->wire, own.wire);
  EXPECT_EQ(read->commit, own.commit);
  EXPECT_EQ(read->scene, "head_press") << "no space crosses";
  EXPECT_EQ(read->checksum, own.checksum);
  EXPECT_EQ(read->host, own.host);
  EXPECT_EQ(read->pid, own.pid);
  EXPECT_EQ(difference(own, *read), "");
}

TEST(Identity, IsNotMadeFromWhatAStrangerSends) {
  EXPECT_FALSE(identity_from(""));
  EXPECT_FALSE(identity_from("palpate-1"));
  EXPECT_FALSE(identity_from("palpate-1 a 3 c s 1f h"));
  EXPECT_FALSE(identity_from("palpate-1 a 3 c s 1f h 7 more"));
  EXPECT_FALSE(identity_from("palpate-1 a x c s 1f h 7"));
  EXPECT_FALSE(identity_from("palpate-1 a 3 c s 1f \x1b[2J 7"))
      << "no control characters on a person's terminal";
  EXPECT_FALSE(identity_from(std::string(100'000, ' ')));
  EXPECT_TRUE(identity_from("palpate-1 a 3 c s 1f h 7"));
  const unsigned seed = std::random_device()();
  std::mt19937 random(seed);
  const std::string good = to_text(sample());
  for (int i = 0; i < 100'000; ++i) {
    std::string text = good;
    for (int n = 0; n < 3; ++n) text[random() % text.size()] = static_cast<char>(random());
    const auto read = identity_from(text);
    if (read) {
      EXPECT_LE(read->host.size(), good.size()) << "seed " << seed;
    }
  }
}

TEST(Identity, NamesWhatDiffers) {
  const Identity own = sample();
  Identity other = *identity_from(to_text(own));
  other.host = "pc2";
  other.checksum ^= 1;
  EXPECT_THAT(difference(own, other), HasSubstr("physics on pc2 has another text of the scene head press"));
  other.scene = "aneurysm";
  EXPECT_THAT(difference(own, other), HasSubstr("runs the scene aneurysm, this PC head press"));
  other.commit = "0123456789";
  EXPECT_THAT(difference(own, other), HasSubstr("of commit 0123456789"));
  other.wire = own.wire + 1;
  EXPECT_THAT(difference(own, other), HasSubstr("wire version")) << "the version comes first";
}

}  // namespace
}  // namespace palpate
