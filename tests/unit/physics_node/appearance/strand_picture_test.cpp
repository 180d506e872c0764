// Strands as one more body of the eye: where both ends are, thin where they are cut, a point where they are torn.
#include "physics_node/appearance/strand_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/scene/scene.h"
#include "physics_node/appearance/appearance.h"
#include "physics_node/world.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using test::Recipe;

Recipe joined(const std::string& velocity) {
  Recipe recipe;
  recipe.lattice = "voxel";
  recipe.shape = Recipe::box(20, 20, 20);
  recipe.spacing_mm = 5;
  recipe.material = "density_kg_per_m3 = 1000\nmodulus_kPa = 100\nviscosity_Pa_s = 50";
  recipe.body = "model = \"fem\"\n";
  recipe.world =
      "[contact]\nenabled = false\n"
      "[[body]]\nname = \"upper\"\nlattice = \"voxel\"\nmodel = \"fem\"\nspacing_mm = 5\nmaterial = \"m\"\n"
      "shape = \"box\"\nsize_mm = [20, 20, 20]\nat_mm = [0, 0, 22]\nvelocity_m_per_s = " +
      velocity +
      "\n[[connection]]\nname = \"bed\"\nfrom = \"upper\"\nto = \"body\"\nwithin_mm = 3\nmodulus_kPa = 1\n"
      "toughness_J_per_m2 = 0.5\n";
  return recipe;
}

struct Seen {
  BodySurface surface;
  std::vector<Array3f> position;
  int surfaces = 0, blocks = 0;
  void look(Appearance& appearance) {
    surfaces = blocks = 0;
    if (appearance.poll())
      appearance.write_surfaces({[this](const BodySurface& chunk) {
                                   if (chunk.body != 2) return;
                                   surface = chunk, ++surfaces;
                                   position.resize(chunk.total_vertices);
                                   std::copy_n(chunk.position.begin(), chunk.n_vertices,
                                               position.begin() + chunk.first_vertex);
                                 },
                                 [](const SurfaceChange&) {}});
    appearance.write_blocks([this](const VertexBlock& block) {
      if (block.body != 2) return;
      ++blocks;
      EXPECT_EQ(block.revision, surface.revision);
      std::copy_n(block.position.begin(), block.n_vertices, position.begin() + block.first_vertex);
    });
  }
  double extent(std::size_t axis) const {
    const auto [lo, hi] =
        std::ranges::minmax_element(position, {}, [axis](const Array3f& p) { return p[axis]; });
    return static_cast<double>((*hi)[axis] - (*lo)[axis]);
  }
  double thickness(std::size_t strand) const {
    const Array3f &a = position[6 * strand], &b = position[6 * strand + 1];
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  }
};

TEST(StrandPicture, IsOneMoreBodyThatFollowsBothOfThem) {
  World world(scene_of(joined("[0, 0, 0.05]")));
  Appearance appearance(world, std::nullopt);
  Seen seen;
  seen.look(appearance);
  EXPECT_EQ(seen.surfaces, 1);
  EXPECT_EQ(seen.blocks, 0) << "the surface has just said where they are";
  EXPECT_EQ(seen.position.size(), 6U * 25);
  EXPECT_EQ(seen.surface.total_facets, 5U * 25);
  EXPECT_NEAR(seen.extent(2), 0.002, 1e-6) << "across the gap";
  for (int n = 0; n < 5; ++n) world.frame({});
  seen.look(appearance);
  EXPECT_EQ(seen.surfaces, 0);
  EXPECT_EQ(seen.blocks, 1);
  const Connection::Ends ends = world.connection(0).places(world.connection(0).strands()[0]);
  const double length = (ends.foot - ends.node).norm();
  EXPECT_GT(length, 0.0021);
  EXPECT_NEAR(seen.extent(2), length, 5e-5);
  seen.look(appearance);
  EXPECT_EQ(seen.blocks, 0) << "nothing has moved";
  appearance.resend();
  seen.look(appearance);
  EXPECT_EQ(seen.blocks, 1);
  appearance.publish_anew(2);
  const std::uint32_t before = seen.surface.revision;
  seen.look(appearance);
  EXPECT_EQ(seen.surfaces, 1);
  EXPECT_EQ(seen.surface.revision, before + 1);
}

TEST(StrandPicture, IsThinnerTheMoreHasBeenCutAndAPointWhenTorn) {
  World world(scene_of(joined("[0, 0, 1]")));
  Appearance appearance(world, std::nullopt);
  Seen seen;
  seen.look(appearance);
  const double whole = seen.thickness(0);
  EXPECT_GT(whole, 1e-4);
  for (int n = 0; n < 100; ++n) world.frame({});
  ASSERT_EQ(world.connection(0).n_torn(), 25);
  seen.look(appearance);
  for (std::size_t s = 0; s < 25; ++s)
    for (std::size_t k = 1; k < 6; ++k) EXPECT_EQ(seen.position[6 * s + k], seen.position[6 * s]);
  world.reset();
  seen.look(appearance);
  EXPECT_NEAR(seen.thickness(0), whole, 1e-7);
}

TEST(StrandPicture, OfAHalfCutStrandIsAsMuchThinner) {
  World world(scene_of(joined("[0, 0, 0]")));
  World cut(scene_of(joined("[0, 0, 0]")));
  const std::vector<Strand>& strands = cut.connection(0).strands();
  Connection connection({strands.begin(), strands.end()}, cut.body(1), cut.body(0));
  const StrandPush half{.strand = 3, .cuts = 0.5};
  connection.cut(std::span(&half, 1));
  Seen seen;
  StrandPicture picture(connection, 2, 0xFFFFFFFF);
  BodySurface chunk;
  picture.write(chunk, [&](const BodySurface& all) {
    seen.position.assign(all.position.begin(), all.position.begin() + 150);
  });
  StrandPicture uncut(world.connection(0), 2, 0xFFFFFFFF);
  Seen before;
  uncut.write(chunk, [&](const BodySurface& all) {
    before.position.assign(all.position.begin(), all.position.begin() + 150);
  });
  EXPECT_NEAR(seen.thickness(3), std::sqrt(0.5) * before.thickness(3), 1e-7);
  EXPECT_NEAR(seen.thickness(4), before.thickness(4), 1e-9);
}

}  // namespace
}  // namespace palpate::physics
