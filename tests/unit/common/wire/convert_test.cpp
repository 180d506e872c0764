#include "common/wire/convert.h"

#include <gtest/gtest.h>

#include "common/wire/topic.h"
#include "tests/support/reference/page.h"
#include "tests/unit/common/wire/break_fields.h"
#include "tests/unit/common/wire/sample_messages.h"

namespace palpate {
namespace {

using test::random_message;

template <class M>
class Conversion : public testing::Test {};
using AllMessages = testing::Types<ToolState, ContactPatch, ToolWrench, BodySurface, SurfaceChange,
                                   VertexBlock, HapticTrace, Pointer, Command, NodeStatus>;
TYPED_TEST_SUITE(Conversion, AllMessages);

TYPED_TEST(Conversion, BringsEveryFieldBack) {
  const auto wire = std::make_unique<typename Topic<TypeParam>::Wire>();
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const auto sent = std::make_unique<TypeParam>(random_message<TypeParam>(seed));
    const auto got = std::make_unique<TypeParam>();
    to_wire(*sent, *wire);
    const Verdict verdict = from_wire(*wire, *got);
    ASSERT_FALSE(verdict) << "seed " << seed << ": " << verdict->field << " is " << text_of(verdict->reason);
    ASSERT_TRUE(*sent == *got) << "seed " << seed;
  }
}

TYPED_TEST(Conversion, NamesTheOtherVersionFirst) {
  typename Topic<TypeParam>::Wire wire{};
  to_wire(random_message<TypeParam>(1), wire);
  wire.version = wire_version + 1;
  EXPECT_EQ(judge(wire), RejectReason::version);
  wire.version = 0;
  EXPECT_EQ(judge(wire), RejectReason::version);
}

TYPED_TEST(Conversion, LeavesTheMessageAloneWhenItRejects) {
  typename Topic<TypeParam>::Wire wire{};
  to_wire(random_message<TypeParam>(2), wire);
  wire.version = 0;
  const TypeParam before = random_message<TypeParam>(3);
  TypeParam message = before;
  EXPECT_TRUE(from_wire(wire, message));
  EXPECT_TRUE(before == message);
}

TYPED_TEST(Conversion, IsAsLongAsItsPageSays) {
  using Wire = typename Topic<TypeParam>::Wire;
  std::string size = std::to_string(sizeof(Wire));
  if (size.size() > 3) size.insert(size.size() - 3, ",");
  const std::string text = test::text_of_source("docs/reference/topics.md"),
                    line = std::string("## `") + Topic<TypeParam>::name + "`\n\n" + size + " bytes, ";
  EXPECT_NE(text.find(line), text.npos) << "docs/reference/topics.md lacks " << line;
}

/// With something in all arrays.
template <class M>
std::unique_ptr<M> full_message() {
  for (std::uint64_t seed = 1;; ++seed) {
    auto message = std::make_unique<M>(random_message<M>(seed));
    bool full = true;
    M::fields(test::LooksForEmpty<M>(*message, full));
    if (full) return message;
  }
}

TYPED_TEST(Conversion, NamesTheFieldWhosePromiseIsBroken) {
  const auto wire = std::make_unique<typename Topic<TypeParam>::Wire>();
  const auto untouched = std::make_unique<TypeParam>();
  const auto message = full_message<TypeParam>();
  int n = 0;
  for (;; ++n) {
    to_wire(*message, *wire);
    ASSERT_FALSE(judge(*wire)) << "the sample to be broken must be whole";
    test::Breach breach;
    int which = n;
    TypeParam::fields(test::BreakField(*wire, which, breach));
    if (breach.field.empty()) break;
    const Verdict verdict = from_wire(*wire, *untouched);
    ASSERT_TRUE(verdict) << "breach " << n << ", " << breach.field;
    EXPECT_EQ(name_of(*verdict), breach.field) << "breach " << n;
    EXPECT_EQ(text_of(verdict->reason), text_of(breach.reason)) << breach.field;
    ASSERT_TRUE(*untouched == TypeParam{}) << breach.field << " was let through in part";
  }
  EXPECT_GT(n, 5);
}

// Any bytes: no verdict may read beyond an array or make an enumeration out of a number that is none (sanitizers watch),
// and what is accepted must be a message that would be accepted again.
template <class M>
void put_words(test::Dice& dice, typename Topic<M>::Wire& wire, std::uint32_t n_words, std::uint32_t within) {
  constexpr std::array<std::uint32_t, 10> edges = {0, 1, 8, 16, 17, 64, 65, 2048, 2049, 0xffffffffU};
  auto* bytes = reinterpret_cast<unsigned char*>(&wire);
  for (std::uint32_t i = 0; i < n_words; ++i) {
    const std::uint32_t word =
        dice.below(2) == 0 ? edges[dice.below(edges.size())] : static_cast<std::uint32_t>(dice.integer());
    std::memcpy(bytes + 4 * dice.below(within / 4), &word, sizeof word);
  }
}

TYPED_TEST(Conversion, SurvivesAHundredThousandRandomByteImages) {
  using Wire = typename Topic<TypeParam>::Wire;
  test::Dice dice(20261121);
  const auto wire = std::make_unique<Wire>();
  const auto again = std::make_unique<Wire>();
  const auto message = std::make_unique<TypeParam>();
  put_words<TypeParam>(dice, *wire, sizeof(Wire) / 2, sizeof(Wire));
  int accepted = 0;
  for (int i = 0; i < 100000; ++i) {
    if (i % 50 == 25)
      to_wire(random_message<TypeParam>(static_cast<std::uint64_t>(i)), *wire);  // nearly whole
    put_words<TypeParam>(dice, *wire, 1 + dice.below(3), dice.below(2) == 0 ? 64 : sizeof(Wire));
    if (dice.below(8) != 0) wire->version = wire_version;
    if (from_wire(*wire, *message)) continue;
    ++accepted;
    to_wire(*message, *again);
    ASSERT_FALSE(judge(*again)) << "image " << i;
  }
  EXPECT_GT(accepted, 100) << "the images hardly reach the later checks";
}

}  // namespace
}  // namespace palpate
