// palpate-haptic: the hand.

#include "common/process/node_main.h"
#include "haptic_node/loop/haptic_node.h"

int main(int argc, char** argv) {
  return palpate::node_main(argc, argv, "palpate-haptic",
                            [](const palpate::NodeOptions& options, const palpate::Scene& scene) {
                              return palpate::haptic::HapticNode(options, scene).run();
                            });
}
