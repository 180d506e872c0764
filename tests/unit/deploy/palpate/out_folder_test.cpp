#include "deploy/palpate/out_folder.h"

#include <gtest/gtest.h>

#include "common/error/error.h"
#include "render_node/image/png_file.h"
#include "tests/unit/deploy/palpate/temporary_folder.h"

namespace palpate::deploy {
namespace {
namespace fs = std::filesystem;

TEST(OutFolder, IsNamedAfterTheScene) {
  EXPECT_EQ(default_out("scenes/head_120x120x70.toml"), fs::path("out/head_120x120x70"));
}

TEST(OutFolder, IsMadeAndFreedOfAnEarlierSession) {
  const test::TemporaryFolder folder;
  const fs::path out = folder / "a/b";
  (void)prepare_out(out);
  EXPECT_TRUE(fs::is_directory(out / "parts"));
  fs::create_directories(out / "frames");
  for (const char* name : {"summary.json", "force.png", "parts/physics.json"})
    folder.write(std::string("a/b/") + name, "old");
  render::write_png({1, 1, {1, 2, 3}}, (out / "frames/frame_00001.png").string());
  render::write_png({1, 1, {1, 2, 3}}, (out / "frames/kept.png").string());
  folder.write("a/b/frames/frame_00002.png", "a picture of my own");
  folder.write("a/b/frames/0001.png", "mine");
  folder.write("a/b/notes.txt", "mine");
  folder.write("a/b/frames/notes.txt", "mine");
  (void)prepare_out(out);
  for (const char* name : {"summary.json", "force.png", "frames/frame_00001.png", "parts/physics.json"}) {
    EXPECT_FALSE(fs::exists(out / name)) << name;
  }
  EXPECT_TRUE(fs::exists(out / "notes.txt"));
  for (const char* name : {"notes.txt", "frame_00002.png", "0001.png", "kept.png"})
    EXPECT_TRUE(fs::exists(out / "frames" / name)) << name;
}

TEST(OutFolder, LosesTheResultsOfAnEarlierRunAndNothingElse) {
  const test::TemporaryFolder folder;
  const fs::path out = folder / "out";
  fs::create_directories(out / "vtk");
  const std::string xml = "<?xml version=\"1.0\"?>\n<VTKFile type=\"", tool = "t_s,x_m,y_m,z_m,fx_N,fy_N\n";
  folder.write("out/energy.csv", "t_s,kinetic_J,elastic_J\n0,1,2\n");
  folder.write("out/tool_tip.csv", tool);
  folder.write("out/record.pvd", xml + "Collection\">");
  folder.write("out/vtk/body_organ_00000.vtp", xml + "PolyData\">");
  folder.write("out/tool_mine.csv", "my own numbers\n");
  folder.write("out/traces.csv", tool);
  folder.write("out/vtk/mine.vtp", xml + "PolyData\">");
  folder.write("out/vtk/tools_00001.vtp", "mine");
  folder.write("elsewhere.csv", tool);
  fs::create_symlink(folder / "elsewhere.csv", out / "tool_link.csv");
  (void)prepare_out(out);
  for (const char* name : {"energy.csv", "tool_tip.csv", "record.pvd", "vtk/body_organ_00000.vtp"})
    EXPECT_FALSE(fs::exists(out / name)) << name;
  for (const char* name :
       {"tool_mine.csv", "traces.csv", "vtk/mine.vtp", "vtk/tools_00001.vtp", "tool_link.csv"})
    EXPECT_TRUE(fs::exists(out / name)) << name;
}

TEST(OutFolder, FollowsNoLinks) {
  const test::TemporaryFolder folder;
  const fs::path out = folder / "out", elsewhere = folder / "elsewhere";
  fs::create_directories(elsewhere);
  render::write_png({1, 1, {1, 2, 3}}, (elsewhere / "frame_00001.png").string());
  folder.write("elsewhere/physics.json", "mine");
  for (const char* name : {"frames", "parts", "vtk"}) {
    fs::create_directories(out);
    fs::create_symlink(elsewhere, out / name);
    EXPECT_THROW((void)prepare_out(out), InputError);
    fs::remove(out / name);
  }
  (void)prepare_out(out);
  fs::create_symlink(elsewhere / "physics.json", out / "summary.json");
  (void)prepare_out(out);
  EXPECT_TRUE(fs::exists(elsewhere / "frame_00001.png"));
  EXPECT_TRUE(fs::exists(elsewhere / "physics.json"));
}

TEST(OutFolder, IsHeldByOne) {
  const test::TemporaryFolder folder;
  const fs::path out = folder / "out";
  {
    const HeldFolder held = prepare_out(out);
    folder.write("out/summary.json", "of the first");
    EXPECT_THROW((void)prepare_out(out), InputError);
    EXPECT_TRUE(fs::exists(out / "summary.json")) << "who is refused removes nothing";
  }
  EXPECT_NO_THROW((void)prepare_out(out));
  EXPECT_FALSE(fs::exists(out / "summary.json"));
}

TEST(OutFolder, CannotStandInAFile) {
  const test::TemporaryFolder folder;
  folder.write("file", "text");
  EXPECT_THROW((void)prepare_out(folder / "file/out"), InputError);
  EXPECT_THROW((void)prepare_out(folder / "file"), InputError);
}

}  // namespace
}  // namespace palpate::deploy
