// Nothing tunnels: spheres shot at plates, tubes and spheres at 0.1 to 100 m/s stay outside.
#include <gtest/gtest.h>

#include <random>

#include "bench/shots/shot.h"
#include "common/scene/body_spec.h"
#include "common/scene/scene.h"
#include "common/scene/surroundings_spec.h"

namespace palpate::bench::test {
namespace {

constexpr double fastest = 100;  // [m/s]

TEST(Tunnelling, NoSurfaceMassGoesThroughAFacetInSweptContact) {
  std::random_device device;
  std::int64_t collisions = 0;
  for (int n = 0; n < 40; ++n) {
    const Shot shot = random_shot(device(), fastest, ContactDistance::swept);
    SCOPED_TRACE("palpate bench shots --seed " + std::to_string(shot.seed));
    const ShotResult result = run_shot(shot);
    EXPECT_EQ(result.passages, 0);
    EXPECT_EQ(result.inside, 0);
    EXPECT_EQ(result.overflows, 0);
    EXPECT_EQ(result.restored, 0);
    collisions += result.collisions;
  }
  EXPECT_GT(collisions, 1000);
}

TEST(Tunnelling, PassagesInPaperContactAreCounted) {
  std::int64_t passages = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    passages += run_shot(random_shot(seed, fastest, ContactDistance::paper)).passages;
  EXPECT_GT(passages, 0) << "mass against mass lets some through";
}

// The bullet crosses the space between the bodies within the first frame.
TEST(Tunnelling, AFastBodyIsSeenInTheFirstFrame) {
  Shot shot = random_shot(1, fastest, ContactDistance::swept);
  shot.speed = 90;
  shot.scene.bodies[1].velocity = 90 * shot.scene.bodies[1].velocity.normalized();
  const ShotResult result = run_shot(shot);
  EXPECT_GT(result.collisions, 0);
  EXPECT_EQ(result.inside, 0);
}

}  // namespace
}  // namespace palpate::bench::test
