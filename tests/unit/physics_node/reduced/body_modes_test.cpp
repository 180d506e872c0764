#include "physics_node/reduced/body_modes.h"

#include <gtest/gtest.h>

#include "physics_node/step/body_model.h"
#include "tests/support/physics/solid_bodies.h"

namespace palpate::physics {
namespace {

using test::solid_block;

TEST(BodyModes, FindHowFarEachIsOut) {
  const auto model =
      make_body_model(solid_block({.cells = 6}), Precision::double_, Integrator::symplectic_euler);
  const Body& body = model->body();
  const BodyModes modes(body, 5);
  ASSERT_EQ(modes.size(), 5u);
  for (const Index node : body.nodes())
    model->place(node, 2e-3 * modes.shape(1, node) - 1e-3 * modes.shape(4, node), 0.3 * modes.shape(2, node));
  std::array<double, 5> q{}, w{};
  modes.measure(*model, q, w);
  const std::array<double, 5> q_true{0, 2e-3, 0, 0, -1e-3}, w_true{0, 0, 0.3, 0, 0};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(q[i], q_true[i], 1e-7) << i;
    EXPECT_NEAR(w[i], w_true[i], 1e-5) << i;
  }
  EXPECT_GT(modes.omega2(0), 0);
}

}  // namespace
}  // namespace palpate::physics
