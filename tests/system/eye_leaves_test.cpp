// What physics tells the eye: only blocks that changed, and nothing at all where nobody looks. By counts of the node itself
// and of an eye that comes and goes.

#include <gtest/gtest.h>

#include <filesystem>

#include "common/report/json_file.h"
#include "common/wire/reader.h"
#include "tests/system/dds_domain.h"
#include "tests/system/memory_room.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

class EyeLeaves : public testing::Test {
 protected:
  EyeLeaves() { fs::create_directories(out); }
  ~EyeLeaves() override { fs::remove_all(out); }

  std::unique_ptr<test::Process> session(const std::string& seconds) const {
    return std::make_unique<test::Process>(
        std::vector<std::string>{PALPATE, "run", SCENE, "--headless", "--nodes", "physics,haptic",
                                 "--seconds", seconds, "--domain", std::to_string(domain), "--out",
                                 out.string()},
        (out / "said").string());
  }
  nlohmann::json summary() const { return read_json((out / "summary.json").string()); }

  int domain = test::own_domain();
  fs::path out = fs::temp_directory_path() / ("palpate_eye_leaves_" + std::to_string(getpid()));
};

TEST_F(EyeLeaves, WithoutOneNothingIsPublished) {
  const auto run = session("2");
  ASSERT_EQ(run->wait(), 0) << run->text();
  const auto told = summary();
  EXPECT_EQ(told["wire"]["physics"]["VertexBlock"]["samples"], 0);
  EXPECT_EQ(told["stages"]["publish"]["calls"], 0);
  EXPECT_GT(told["stages"]["publish"]["skipped"].get<int>(), 10);
  EXPECT_GT(told["wire"]["physics"]["ContactPatch"]["samples"].get<int>(), 100)
      << "the hand is told all the same";
}

TEST_F(EyeLeaves, WhatItSawIsAllThatWasSent) {
  const auto run = session("8");
  ASSERT_TRUE(run->said("physics [a-z]")) << run->text();  // it wants the domain empty when it begins
  auto eye = std::make_unique<Participant>(domain);
  auto blocks = std::make_unique<Reader<VertexBlock>>(*eye);
  auto surfaces = std::make_unique<Reader<BodySurface>>(*eye);
  const auto block = std::make_unique<VertexBlock>();
  const auto chunk = std::make_unique<BodySurface>();
  std::uint32_t total_vertices = 0;
  std::uint64_t first_tick = 0, last_tick = 0;
  std::map<std::uint32_t, int> came;  // by number of the block
  const auto end = std::chrono::steady_clock::now() + 60s;
  while (std::chrono::steady_clock::now() < end && last_tick < first_tick + 300) {
    while (surfaces->take(*chunk)) total_vertices = chunk->total_vertices;
    blocks->wait(10ms);
    while (blocks->take(*block)) {
      ++came[block->block];
      if (first_tick == 0) first_tick = block->tick;
      last_tick = block->tick;
    }
  }
  blocks.reset();
  surfaces.reset();
  eye.reset();
  ASSERT_EQ(run->wait(), 0) << run->text();
  const auto told = summary();
  const int calls = told["stages"]["publish"]["calls"];
  const auto n_blocks = static_cast<int>((total_vertices + max_block_vertices - 1) / max_block_vertices);
  ASSERT_GT(n_blocks, 3) << "the scene must have blocks to leave out";
  EXPECT_EQ(came.size(), static_cast<std::size_t>(n_blocks)) << "each came once, when the eye did";
  int seen = 0;
  for (const auto& [number, times] : came) seen += times;
  const int sent = told["wire"]["physics"]["VertexBlock"]["samples"];
  EXPECT_GE(sent, seen);
  EXPECT_LT(sent, calls * n_blocks) << "blocks at rest stay at home";
  EXPECT_GT(told["stages"]["publish"]["skipped"].get<int>(), 10) << "after the eye had gone";
  RecordProperty("blocks", n_blocks);
  RecordProperty("calls", calls);
  RecordProperty("sent", sent);
  RecordProperty("seen", seen);
}

}  // namespace
}  // namespace palpate
