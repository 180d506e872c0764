#include "physics_node/mesh/write_msh.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "common/error/error.h"
#include "physics_node/mesh/read_msh.h"
#include "physics_node/mesh/tet_box.h"
#include "tests/support/image/scratch_folder.h"

namespace palpate::physics {
namespace {

TEST(WriteMsh, ComesBackAsItWas) {
  TetMesh mesh = make_tet_box({.cells = {3, 2, 1}, .edge = 0.01, .jitter = 0.1});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.region[t] = static_cast<int>(t % 3);
  const MshContent back = parse_msh(msh_text(mesh, 0.001), "text", 0.001);
  EXPECT_EQ(back.mesh.tets, mesh.tets);
  EXPECT_EQ(back.mesh.region, mesh.region);
  ASSERT_EQ(back.mesh.nodes.size(), mesh.nodes.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    EXPECT_LT((back.mesh.nodes[n] - mesh.nodes[n]).norm(), 1e-10) << "nine digits of 30 mm";
  EXPECT_EQ(back.tidied.turned + back.tidied.unused + back.other, 0u);
}

TEST(WriteMsh, LeavesOnlyTheWholeFile) {
  const test::ScratchFolder folder;
  const std::string path = folder / "box.msh";
  write_msh(path, make_tet_box({}), 1);
  EXPECT_EQ(read_msh(path).mesh.tets.size(), 6u);
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
  EXPECT_THROW(write_msh(folder / "no/box.msh", make_tet_box({}), 1), InputError);
}

}  // namespace
}  // namespace palpate::physics
