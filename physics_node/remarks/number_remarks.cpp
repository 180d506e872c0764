// Figures that another unit would explain. Bounds lie a factor of five and more beyond soft tissue and beyond the scenes of the
// papers (whose knives are of 2 MPa, whose block is of 20): a person who means it reads one line.

#include <fmt/format.h>

#include <algorithm>

#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "physics_node/remarks/remarks.h"

namespace palpate::physics {
namespace {

constexpr double softest_Pa = 50, stiffest_Pa = 1e8;  // a jelly; past it lies bone
constexpr double lightest = 50, heaviest = 25000;     // [kg/m^3]: lung; tungsten
constexpr double smallest_m = 1e-3, largest_m = 5;    // of a body
constexpr double most_gravity = 50;                   // [m/s^2]
constexpr double slowest_frame_Hz =
    50;  // Why: below, three patch periods are so long that the hand is often without an answer
constexpr int busy_steps_a_frame =
    300;  // Why: even a thousand masses then take longer than the frame on one core

/// Why: explicit steps of an element with lag beta and highest frequency w end at 2 (sqrt(1 + z^2) - z) / w, z = beta w / 2; at z = 1
/// viscosity has taken more than half of the step, and beta is 2.4 steps.
constexpr double viscous_lag_of_a_step = 2.4;

/// A bar of stable neo-Hookean tissue, free at its sides, is pressed hardest at this share L of its length, and gives way below:
///   P(L) / mu = L + [k (J - 1) - 1] w,   J = L w,   w = ((1 + k) L - 1) / (k L^2) the square of its width,   k = 1 + lambda / mu
double pressed_hardest_at(double poisson_ratio) {
  const double k = 1 + 2 * poisson_ratio / (1 - 2 * poisson_ratio);
  double least = 0, at = 1;
  for (double L = 1; L > 0.2; L -= 1e-3) {
    const double w = ((1 + k) * L - 1) / (k * L * L);
    const double P = L + (k * (L * w - 1) - 1) * w;
    if (P < least) least = P, at = L;
  }
  return at;
}
constexpr double rarely_pressed_to = 0.5;  // of its length

/// A scene need not have the table.
std::string place_of_physics(const Scene& scene) {
  const std::string place = scene.physics->place.text();
  return place.empty() ? scene.path + ": [physics]" : place;
}

void add_materials(const Scene& scene, Remarks& remarks) {
  for (const MaterialSpec& material : scene.materials) {
    const std::string who = fmt::format("{}: material \"{}\"", material.place.text(), material.name);
    if (material.modulus && *material.modulus < softest_Pa)
      remarks.push_back(fmt::format(
          "{} has a modulus of {:.3g} kPa, softer than jelly; tissue has 0.5 to 1000 (the key is in kPa, "
          "not MPa)",
          who, 1e-3 * *material.modulus));
    if (material.modulus && *material.modulus > stiffest_Pa)
      remarks.push_back(fmt::format(
          "{} has a modulus of {:.3g} kPa, as stiff as bone; tissue has 0.5 to 1000 (the key is in kPa, "
          "not Pa)",
          who, 1e-3 * *material.modulus));
    if (material.law == TissueLaw::green)
      remarks.push_back(
          who +
          " has law = \"green\", which gives way where a cell is squeezed below 0.6 of its length; leave "
          "it out where tissue is pressed deep");
    const double hardest = pressed_hardest_at(material.poisson_ratio);
    if (material.modulus && material.law == TissueLaw::neo_hookean && hardest > rarely_pressed_to)
      remarks.push_back(
          fmt::format("{} has poisson_ratio = {:g}: the law gives way where it is pressed below {:.2f} of "
                      "its length; soft "
                      "tissue has 0.4 to 0.49",
                      who, material.poisson_ratio, hardest));
    if (material.density && (*material.density < lightest || *material.density > heaviest))
      remarks.push_back(
          fmt::format("{} has a density of {:.3g} kg/m^3; tissue has about 1000 (g/cm^3 times 1000)", who,
                      *material.density));
  }
}

void add_sizes(const Scene& scene, const Bodies& bodies, Remarks& remarks) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Body& body = bodies[b]->body();
    const double size = box_of(body).sizes().maxCoeff();
    if (size < smallest_m || size > largest_m)
      remarks.push_back(fmt::format("{}: body \"{}\" measures {:.3g} mm; lengths are in millimetres",
                                    scene.bodies[b].place.text(), body.name, 1e3 * size));
  }
}

/// What would make steps fewer: viscosity, where its own bound is the narrower, and what the scene's materials allow.
std::string what_takes_fewer(const Scene& scene, const Bodies& bodies, int steps_a_frame) {
  const double step = 1 / (scene.physics->frame_Hz * steps_a_frame);
  bool damped = false, relaxes = false, is_mesh = false;
  for (const auto& body : bodies) {
    damped = damped || damper_time(body->body()) > viscous_lag_of_a_step * step;
    is_mesh = is_mesh || body->body().mesh;
    if (!body->body().solid) continue;
    relaxes = relaxes || !body->body().solid->relaxation.empty();
  }
  std::string means = "larger cells, softer or heavier material";
  if (damped) means = "less viscosity, " + means;
  if (is_mesh) return means + " take fewer";
  if (!relaxes) means += ", or integrator = \"backward_euler\"";
  return means + (relaxes ? " takes fewer" : " take fewer");
}

}  // namespace

Remarks number_remarks(const Scene& scene, const Bodies& bodies, int steps_a_frame) {
  Remarks remarks;
  if (scene.gravity.norm() > most_gravity)
    remarks.push_back(fmt::format(
        "{}: gravity is {:.4g} m/s^2; that of the earth is 9.81 (the key is in m/s^2, not mm/s^2)",
        scene.path, scene.gravity.norm()));
  if (scene.gravity.z() > 0)
    remarks.push_back(fmt::format("{}: gravity points up, [0, 0, -9.81] points down", scene.path));
  if (!scene.tools.empty() && scene.physics->frame_Hz < slowest_frame_Hz)
    remarks.push_back(fmt::format(
        "{}: at {:.4g} frames a second the hand is often without an answer; frame_Hz = 1000 is usual",
        place_of_physics(scene), scene.physics->frame_Hz));
  if (steps_a_frame > busy_steps_a_frame)
    remarks.push_back(fmt::format("{}: {} steps a frame are too many for real time; {}",
                                  place_of_physics(scene), steps_a_frame,
                                  what_takes_fewer(scene, bodies, steps_a_frame)));
  add_materials(scene, remarks);
  add_sizes(scene, bodies, remarks);
  return remarks;
}

}  // namespace palpate::physics
