// Each rule about a reference page catches a page that says something else than the sources.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/scene/scene.h"
#include "tests/house/planted_house.h"

namespace palpate::house {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST_F(PlantedHouse, RefusesTopicsThatAreNotThoseOfTheIdl) {
  plant("idl/palpate.idl",
        "@final @topic struct Tip {\n  uint32 version;\n  @key uint32 tool;\n  double p[3];\n};\n");
  const std::string rows =
      "## `Tip`\n\n| field | type | meaning |\n|---|---|---|\n| `version` | `uint32` | a |\n";
  const std::string tool = "| `tool` | `uint32`, key | b |\n", p = "| `p` | `double[3]` | c |\n";
  EXPECT_TRUE(is_fine("docs/reference/topics.md", rows + tool + p));
  EXPECT_THAT(breach("docs/reference/topics.md", rows + tool), HasSubstr("lacks \"Tip.p double[3]\""));
  EXPECT_THAT(breach("docs/reference/topics.md", rows + tool + p + "| `q` | `double` | d |\n"),
              HasSubstr("\"Tip.q double\" is not in idl/palpate.idl"));
}

TEST_F(PlantedHouse, RefusesMessagesThatLeaveFieldsOfTheIdlOut) {
  plant("idl/palpate.idl",
        "@final @topic struct Tip {\n  uint32 version;\n  @key uint32 tool;\n  double p[3];\n};\n");
  const std::string page = "common/message/tip_messages.h", begin = "#pragma once\nstruct Tip {\n",
                    tool = "visit(PALPATE_FIELD(tool), any);\n", p = "visit(PALPATE_FIELD(p), any);\n";
  EXPECT_TRUE(is_fine(page, begin + tool + p));
  EXPECT_THAT(breach(page, begin + tool),
              HasSubstr("fields() of Tip does not name the fields of idl/palpate.idl"));
  EXPECT_THAT(breach(page, begin + p + tool), HasSubstr("in its order"));
}

TEST_F(PlantedHouse, RefusesStagesThatAreNotThoseOfTheEnum) {
  plant("physics_node/step/step_report.h",
        "enum class Stage : std::size_t {\n  take,  // first\n  push,\n};\n");
  const std::string head = "## Stages\n\n| stage | one call per |\n|---|---|\n",
                    take = "| `take` | frame |\n", push = "| `push` | step |\n";
  EXPECT_TRUE(is_fine("docs/reference/stages.md", head + take + push));
  EXPECT_THAT(breach("docs/reference/stages.md", head + take), HasSubstr("lacks \"push\""));
  EXPECT_THAT(breach("docs/reference/stages.md", head + push + take), HasSubstr("in another order"));
}

TEST_F(PlantedHouse, RefusesOptionsThatNoDriverAsksFor) {
  plant("haptic_node/drivers/toy/toy_driver.cpp", "s.gain = options.positive(\"gain\", 1.0);\n");
  const std::string head = "### Options of the drivers\n\n| driver | option |\n|---|---|\n";
  EXPECT_TRUE(is_fine("docs/reference/scene.md", head + "| `toy` | `gain` |\n"));
  EXPECT_THAT(breach("docs/reference/scene.md", head), HasSubstr("lacks \"toy gain\""));
  EXPECT_THAT(breach("docs/reference/scene.md", head + "| `toy` | `gain` |\n| `toy` | `gian` |\n"),
              HasSubstr("\"toy gian\" is not in haptic_node/drivers"));
}

TEST_F(PlantedHouse, RefusesSummaryKeysThatNobodyWrites) {
  plant("render_node/render_loop.cpp",
        "report = {{\"frames\", n}};\npart = {{\"render\", report}};\nreport[\"fps\"] = f;\n");
  const std::string head = "## Pictures\n\n| key | unit |\n|---|---|\n", frames = "| `render.frames` | |\n";
  EXPECT_TRUE(is_fine("docs/reference/summary.md", head + frames + "| `render.fps` | 1/s |\n"));
  EXPECT_THAT(breach("docs/reference/summary.md", head + frames), HasSubstr("lacks \"fps\""));
  EXPECT_THAT(breach("docs/reference/summary.md", head + frames + "| `render.fps` | |\n| `render.fsp` | |\n"),
              HasSubstr("\"fsp\" is not in render_node/render_loop.cpp"));
}

TEST_F(PlantedHouse, RefusesListsThatNameNoFile) {
  EXPECT_TRUE(is_fine("docs/contributing.md",
                      "1. `common/math/sum.h`\n2. `physics_node/NAME.cpp`, `common/math/*.h`, `common/`\n"));
  EXPECT_THAT(breach("docs/contributing.md", "\n1. `common/math/sums.h`: add it\n"),
              StartsWith("docs/contributing.md:2: there is no common/math/sums.h"));
  EXPECT_THAT(breach("docs/contributing.md", "`common/maths/NAME.h`\n"),
              HasSubstr("there is no common/maths/NAME.h"));
  EXPECT_THAT(breach("docs/contributing.md", "`common/math/su`\n"), HasSubstr("there is no common/math/su"));
  EXPECT_THAT(breach("docs/contributing.md", "nothing\n"), HasSubstr("names no file"));
}

TEST_F(PlantedHouse, RefusesPagesThatMentionFilesOfTheDayBefore) {
  EXPECT_TRUE(is_fine(
      "docs/a.md", "`common/math/sum`, `common/math/{sum,units}`, `physics_node/main.cpp`, `other/x.h`\n"));
  EXPECT_THAT(breach("docs/a.md", "\nin `common/maths/sum`\n"),
              StartsWith("docs/a.md:2: there is no common/maths/sum"));
}

TEST_F(PlantedHouse, RefusesLinksThatLeadNowhere) {
  plant("docs/b.md", "# B\n\n## The `guard`, again\n");
  EXPECT_TRUE(
      is_fine("docs/a.md",
              "[b](b.md), [g](b.md#the-guard-again), [s](../common/math/sum.h), [w](https://x.org/y)\n"));
  EXPECT_TRUE(is_fine("docs/a.md", "## Here\n[h](#here) and [math](../common/math/)\n"));
  EXPECT_THAT(breach("docs/a.md", "\n[c](c.md)\n"),
              StartsWith("docs/a.md:2: a link to docs/c.md, which is not there"));
  EXPECT_THAT(breach("docs/a.md", "[g](b.md#the-guard)\n"),
              HasSubstr("#the-guard, which is no heading of docs/b.md"));
  EXPECT_THAT(breach("docs/a.md", "[h](#there)\n"), HasSubstr("#there, which is no heading of docs/a.md"));
}

}  // namespace
}  // namespace palpate::house
