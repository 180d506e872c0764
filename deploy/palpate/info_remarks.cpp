#include <fmt/format.h>

#include "common/error/error.h"
#include "deploy/palpate/info.h"
#include "physics_node/forecast/memory_need.h"
#include "physics_node/remarks/remarks.h"

namespace palpate::deploy {

std::string remarks_text(const Scene& scene) {
  std::vector<std::string> lines;
  try {
    physics::refuse_too_large(scene, physics::usable_memory());
    const physics::World world(scene);
    lines = world.remarks();
    for (auto& line : physics::remarks_about(world)) lines.push_back(std::move(line));
  } catch (const InputError& error) {
    lines = error.complaints();
  }
  std::string text;
  for (const auto& line : lines) text += fmt::format("remark       {}\n", line);
  return text;
}

}  // namespace palpate::deploy
