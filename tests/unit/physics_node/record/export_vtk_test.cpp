// The export as VTK itself reads it: places, displacement, what yields and breaks, forces, scenery, time.

#include "physics_node/record/export_vtk.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <fstream>

#include "common/error/error.h"
#include "common/record/hdf5_file.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "physics_node/record/recorder.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/physics/pressed_world.h"
#include "tests/unit/physics_node/record/viewer.h"

namespace palpate::physics {
namespace {

using namespace test;
using palpate::test::ScratchFolder;
namespace fs = std::filesystem;

constexpr const char* all_kept = "[record]\nwhat = [\"positions\", \"forces\"]\nrate_Hz = 100\n";

class Export : public testing::Test {
 protected:
  /// Runs a world for some frames of a millisecond.
  void record(const Scene& scene, int frames, const std::optional<ToolState>& hand = {}) {
    scene_ = scene;
    world_ = std::make_unique<World>(scene_);
    Recorder recorder(*world_, SceneSource{}, folder_.path(), Recorder::WhenBehind::wait);
    const std::size_t n_hands = scene_.tools.size();
    for (int n = 0; n < frames; ++n) {
      world_->frame(std::span(&hand, n_hands));
      recorder.frame(*world_, std::span(&hand, n_hands));
    }
    recorder.finish(*world_);
  }
  VtkExport run(VtkWish wish = {}) {
    wish.folder = folder_.path();
    return export_vtk(folder_ / "record.h5", scene_, wish);
  }
  static nlohmann::json part(const nlohmann::json& step, const std::string& begin) {
    for (const auto& one : step["parts"])
      if (one["file"].get<std::string>().starts_with(begin)) return one;
    return nullptr;
  }
  static fs::perms rights(const fs::path& path) { return fs::status(path).permissions(); }

  ScratchFolder folder_;
  Scene scene_;
  std::unique_ptr<World> world_;
};

TEST_F(Export, ShowsAPressedSlab) {
  Recipe recipe = pressed_slab_recipe();
  recipe.world += all_kept;
  record(scene_of(recipe), 200, steady_hand({0, 0, 1.5}));
  const VtkExport done = run({.folder = {}, .rate_Hz = 50});
  EXPECT_EQ(done.times, 10u);  // of 0.001, 0.01, 0.02 ... 0.2: the first, then the next 0.02 s later
  EXPECT_FALSE(done.thinned);
  const auto seen = seen_by_vtk(done.collection);
  ASSERT_TRUE(seen.is_array());
  ASSERT_EQ(seen.size(), 10u);
  const double slab = 48e-3 * 48e-3 * 20e-3;
  const auto first = part(seen.front(), "body_body_"), last = part(seen.back(), "body_body_");
  EXPECT_NEAR(first["volume"].get<double>(), slab, 0.01 * slab);
  EXPECT_LT(last["volume"].get<double>(), slab);
  EXPECT_EQ(last["corners"], 4);
  EXPECT_NEAR(seen.front()["t"].get<double>(), 0.001, 1e-9);
  EXPECT_NEAR(last["t_in_file"].get<double>(), seen.back()["t"].get<double>(), 1e-7);
  EXPECT_NEAR(first["bounds"][5].get<double>(), slab_top, 1e-4);
  // The largest displacement in the file is that of the world at that time.
  const Hdf5File file(folder_ / "record.h5", Hdf5File::Mode::read);
  const auto rest = file.read<float>("/bodies/body/rest"), at = file.read<float>("/bodies/body/position");
  const auto times = file.read<double>("/bodies/body/time");
  std::size_t row = 0;
  while (times[row] + 1e-9 < seen.back()["t"].get<double>()) ++row;
  double largest = 0;
  for (std::size_t n = 0; n < rest.size(); n += 3) {
    const auto d = [&](std::size_t a) { return double{at[row * rest.size() + n + a]} - double{rest[n + a]}; };
    largest = std::max(largest, std::hypot(d(0), d(1), d(2)));
  }
  EXPECT_GT(largest, 5e-4);
  EXPECT_NEAR(last["arrays"]["displacement"][1].get<double>(), largest, 1e-6);
  EXPECT_FALSE(last["arrays"].contains("yielded_share")) << "this material does not yield";
  const auto tools = part(seen.back(), "tools_");
  EXPECT_EQ(tools["points"], 1);
  EXPECT_NEAR(tools["arrays"]["force"][1].get<double>(), world_->tool(0).wrench().force.norm(), 0.02);
  EXPECT_NEAR(tools["first"][2].get<double>(), slab_top - 0.002, 1e-6);
}

/// A brittle block flies apart: the surface follows what breaks, and says how much of each mass has yielded.
TEST_F(Export, FollowsWhatYieldsAndBreaks) {
  Recipe recipe;
  recipe.shape = Recipe::box(40, 40, 40);
  recipe.spacing_mm = 8;
  recipe.material =
      "density_kg_per_m3 = 1000\nmodulus_kPa = 20\nk2_ratio = 0.3\nyield_ratio = 1.05\nbreak_ratio = 1.2";
  recipe.gravity = "[0, 0, -9.81]";
  recipe.world = floor_at(-60) + all_kept;
  record(scene_of(recipe), 300);
  const VtkExport done = run({.folder = {}, .rate_Hz = 20});
  const auto seen = seen_by_vtk(done.collection);
  ASSERT_EQ(seen.size(), done.times);
  const auto first = part(seen.front(), "body_body_"), last = part(seen.back(), "body_body_");
  EXPECT_EQ(first["arrays"]["yielded_share"][1].get<double>(), 0);
  ASSERT_GT(world_->body(0).breaks(), 20) << "or this shows nothing";
  EXPECT_GT(last["arrays"]["yielded_share"][1].get<double>(), 0.05);
  EXPECT_LE(last["arrays"]["yielded_share"][1].get<double>(), 1.0);
  EXPECT_GT(last["cells"].get<int>(), first["cells"].get<int>()) << "cracks are open";
  // As many facets as the surface of the world has now: the last time is the last state.
  const Surface now = make_surface(world_->body(0), scene_.render->threshold, 0);
  EXPECT_NEAR(last["cells"].get<double>(), static_cast<double>(now.facets.size()),
              0.2 * static_cast<double>(now.facets.size()));
}

TEST_F(Export, KeepsToItsBudget) {
  Recipe recipe = pressed_slab_recipe();
  recipe.world += all_kept;
  record(scene_of(recipe), 300, steady_hand({0, 0, 1.5}));
  const VtkExport whole = run({.folder = {}, .rate_Hz = 100});
  const VtkExport third = run({.folder = {}, .rate_Hz = 100, .most_bytes = whole.bytes / 3});
  EXPECT_TRUE(third.thinned);
  EXPECT_LE(third.bytes, whole.bytes / 3);
  EXPECT_GE(third.times, whole.times / 4);
  EXPECT_GT(third.every_s, 2 * whole.every_s);
  EXPECT_EQ(seen_by_vtk(third.collection).size(), third.times);
  std::size_t bodies = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "vtk"))
    bodies += entry.path().filename().string().starts_with("body_") ? 1 : 0;
  EXPECT_EQ(bodies, third.times) << "those of the export before are gone";
}

TEST_F(Export, IsAsPrivateAsTheRecordAndTouchesNothingElse) {
  Recipe recipe = pressed_slab_recipe();
  recipe.world += all_kept;
  record(scene_of(recipe), 30, steady_hand({0, 0, 1.5}));
  fs::create_directories(folder_ / "vtk");
  for (const char* mine : {"vtk/mine.vtp", "vtk/body_notes.txt", "notes.pvd"})
    std::ofstream(folder_ / mine) << "mine";
  chmod((folder_ / "record.h5").c_str(), 0600);
  const VtkExport done = run();
  for (const char* mine : {"vtk/mine.vtp", "vtk/body_notes.txt", "notes.pvd"})
    EXPECT_TRUE(fs::exists(folder_ / mine));
  EXPECT_EQ(rights(done.collection), fs::perms{0600});
  EXPECT_EQ(rights(folder_ / "vtk"), fs::perms{0700});
  EXPECT_EQ(rights(folder_ / "vtk/body_body_00001.vtp"), fs::perms{0600});
  chmod((folder_ / "record.h5").c_str(), 0644);
  run();
  EXPECT_EQ(rights(folder_ / "vtk"), fs::perms{0755});
  EXPECT_EQ(rights(folder_ / "vtk/body_body_00001.vtp"), fs::perms{0644});
}

TEST_F(Export, SaysThatThereIsNothingOrThatItDoesNotFit) {
  record(pressed_slab(), 5);
  EXPECT_TRUE(run().collection.empty()) << "no positions were recorded";
  EXPECT_FALSE(fs::exists(folder_ / "vtk"));
  Recipe recipe = pressed_slab_recipe();
  recipe.world += all_kept;
  record(scene_of(recipe), 5, steady_hand({0, 0, 1.5}));
  recipe.spacing_mm = 6;
  scene_ = scene_of(recipe);
  EXPECT_THROW(run(), InputError);
}

}  // namespace
}  // namespace palpate::physics
