// palpate-physics: the tissue.

#include "common/process/node_main.h"
#include "physics_node/loop/physics_loop.h"

int main(int argc, char** argv) {
  return palpate::node_main(argc, argv, "palpate-physics",
                            [](const palpate::NodeOptions& options, const palpate::Scene& scene) {
                              return palpate::physics::PhysicsLoop(options, scene).run();
                            });
}
