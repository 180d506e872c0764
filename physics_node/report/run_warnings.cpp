#include "physics_node/report/run_warnings.h"

#include <fmt/format.h>

namespace palpate::physics {
namespace {

struct Kind {
  bool (*holds)(const World&) noexcept;
  std::string (*text)(const World&);
};

const Kind kinds[] = {
    {[](const World& w) noexcept { return w.report().restored > 0; },
     [](const World& w) {
       return fmt::format("the guard brought the last good state back {} time(s) and halved the step {} time(s), to {:.3g} ms; "
                          "look at materials, first positions and what the tools do, or set a smaller physics.step_ms",
                          w.report().restored, w.report().halved, 1e3 * w.step_seconds());
     }},
    {[](const World& w) noexcept { return w.report().unsolved > 0; },
     [](const World& w) {
       return fmt::format("{} of {} steps of backward_euler were not solved to their tolerance; set a smaller physics.step_ms",
                          w.report().unsolved, w.report().steps);
     }},
    {[](const World& w) noexcept { return w.collisions() != nullptr && w.collisions()->tally().overflows > 0; },
     [](const World& w) {
       return fmt::format("{} pairs of masses found no room in the contact list and were not held apart",
                          w.collisions()->tally().overflows);
     }},
};
static_assert(std::size(kinds) <= most_warning_kinds);

}  // namespace

WarningKinds raised_warnings(const World& world) noexcept {
  WarningKinds raised;
  for (std::size_t k = 0; k < std::size(kinds); ++k) raised[k] = kinds[k].holds(world);
  return raised;
}

std::vector<std::string> warning_texts(const World& world, WarningKinds which) {
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < std::size(kinds); ++k)
    if (which[k]) texts.push_back(kinds[k].text(world));
  return texts;
}

std::vector<std::string> all_warnings(const World& world) {
  std::vector<std::string> texts = world.remarks();
  for (std::string& text : warning_texts(world, raised_warnings(world))) texts.push_back(std::move(text));
  return texts;
}

}  // namespace palpate::physics
