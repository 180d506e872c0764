// [scene], [physics], [floor] and [contact].
#include <fmt/format.h>

#include "common/math/units.h"
#include "common/scene/physics_spec.h"
#include "common/scene/read_parts.h"
#include "common/scene/scene.h"
#include "common/scene/surroundings_spec.h"

namespace palpate {
namespace {

/// step = "auto", or step_ms = a number, not both.
void read_step(TableReader& reader, PhysicsSpec& physics) {
  const auto* word = reader.find("step");
  const auto step_ms = reader.read_number("step_ms", positive);
  if (word != nullptr && reader.has("step_ms"))
    reader.complain("step_ms", "both \"step\" and \"step_ms\" are given; keep one of them");
  else if (word != nullptr && word->value_or(std::string()) != "auto")
    reader.complain_value("step", *word, "\"auto\", or step_ms = a number of milliseconds instead");
  if (step_ms) physics.step = *step_ms * 1e-3;
}

}  // namespace

void read_run(TableReader& root, ReadContext& context) {
  const auto* table = root.read_table("scene");
  if (table == nullptr) return;
  TableReader reader(*table, "[scene]", context.complaints);
  context.scene.seconds = reader.read_number("seconds", run_seconds);
  reader.refuse_left_over();
}

void read_physics(TableReader& root, ReadContext& context) {
  const auto* table = root.read_table("physics");
  if (table == nullptr) return;
  TableReader reader(*table, "[physics]", context.complaints);
  auto& physics = *context.scene.physics;
  physics.place = reader.place();
  if (const auto word =
          reader.read_word("integrator", {"symplectic_euler", "velocity_verlet", "backward_euler", "auto"}))
    physics.integrator = static_cast<Integrator>(*word);
  read_step(reader, physics);
  set_if(physics.safety, reader.read_number("safety", {.lo = 0, .hi = 1, .without_lo = true}));
  if (const auto word = reader.read_word("precision", {"single", "double"}))
    physics.precision = static_cast<Precision>(*word);
  if (const auto threads = reader.read_integer("threads", 0, 256))
    physics.threads = static_cast<int>(*threads);
  set_if(physics.frame_Hz, reader.read_number("frame_Hz", {.lo = 20, .hi = 20000}));
  set_if(physics.sleep, reader.read_flag("sleep"));
  set_if(physics.subcycle, reader.read_flag("subcycle"));
  reader.refuse_left_over();
}

void read_floor(TableReader& root, ReadContext& context) {
  const auto* table = root.read_table("floor");
  if (table == nullptr) return;
  TableReader reader(*table, "[floor]", context.complaints);
  FloorSpec floor;
  reader.require("height_mm", "give the height of its surface");
  set_if(floor.height, reader.read_length_mm("height_mm", any_number));
  reader.refuse_left_over();
  context.scene.floor = floor;
}

void read_contact(TableReader& root, ReadContext& context) {
  const auto* table = root.read_table("contact");
  if (table == nullptr) return;
  TableReader reader(*table, "[contact]", context.complaints);
  set_if(context.scene.contact->enabled, reader.read_flag("enabled"));
  if (const auto word = reader.read_word("distance", {"paper", "swept"}))
    context.scene.contact->distance = static_cast<ContactDistance>(*word);
  set_if(context.scene.contact->restitution, reader.read_number("restitution", {.lo = 0, .hi = 1}));
  set_if(context.scene.contact->count_passages, reader.read_flag("count_passages"));
  reader.refuse_left_over();
}

}  // namespace palpate
