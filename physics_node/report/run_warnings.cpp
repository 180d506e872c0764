#include "physics_node/report/run_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/scene/physics_spec.h"
#include "common/scene/scene.h"
#include "common/scene/surroundings_spec.h"
#include "common/scene/tool_spec.h"

namespace palpate::physics {
namespace {

struct Kind {
  bool (*holds)(const World&) noexcept;
  std::string (*text)(const World&);
};

constexpr double most_balance_error = 0.01;
constexpr double most_generated =
    0.01;  // of what was exchanged. Why: the scenes that ship stay below half of it

/// Energy that steps and contact have put in: booked, so that the balance does not tell. [J]
double generated(const EnergyLedger& ledger) {
  return std::max(0.0, -ledger.numerical) + std::max(0.0, -ledger.contact);
}

/// In steps of some microseconds nodes move by less than single precision tells: smaller ones make it worse.
const char* remedy_of_balance(const World& world) {
  constexpr double short_step = 2e-5;  // [s]
  const bool rounds =
      world.scene().physics->precision == Precision::single_ && world.step_seconds() < short_step;
  return rounds ? "write precision = \"double\" in [physics]" : "set a smaller physics.step_ms";
}

std::string remedy(const World& world) {
  const ContactSpec& contact = *world.scene().contact;
  if (!contact.enabled) return "contact is switched off: set contact.enabled = true";
  if (contact.distance == ContactDistance::paper)
    return "contact of masses with masses lets them through: set contact.distance = \"swept\"";
  return "are they inside each other at the start? if not, set a smaller physics.step_ms or stiffer "
         "materials";
}

/// For want of room, of all bodies.
std::uint64_t faces_kept_joined(const World& world) noexcept {
  std::uint64_t n = 0;
  for (std::size_t b = 0; b < world.n_bodies(); ++b) {
    const Body& body = world.body(b).body();
    if (body.mesh && body.mesh->copies() != nullptr) n += body.mesh->copies()->left_out();
    if (const CellNet* net = body.cell_net()) n += net->left_out();
  }
  return n;
}

/// Calls visit(tool, body, area) for each that has passed a body unfelt. @return none has
template <class Visit>
bool each_passed_unfelt(const World& world, const Visit& visit) {
  constexpr double least =
      1e-6;  // Why: an edge that grazes a body; looks are a quarter of a millimetre apart [m^2]
  bool none = true;
  for (std::size_t n = 0; n < world.n_tools(); ++n) {
    const auto passed = world.tool(n).book().passed_unfelt();
    for (std::size_t b = 0; b < passed.size(); ++b)
      if (passed[b] > least) visit(n, b, passed[b]), none = false;
  }
  return none;
}

const Kind kinds[] = {
    {[](const World& w) noexcept { return w.inside_others() != nullptr && w.inside_others()->any(); },
     [](const World& w) { return inside_text(w, *w.inside_others()); }},
    {[](const World& w) noexcept {
       return w.collisions() != nullptr && w.collisions()->tally().passages > 0;
     },
     [](const World& w) {
       return fmt::format("{} times a mass went through a facet; {}", w.collisions()->tally().passages,
                          remedy(w));
     }},
    {[](const World& w) noexcept { return w.report().restored > 0; },
     [](const World& w) {
       return fmt::format(
           "the guard brought the last good state back {} time(s) and halved the step {} time(s), to {:.3g} "
           "ms; "
           "look at materials, first positions and what the tools do, or set a smaller physics.step_ms",
           w.report().restored, w.report().halved, 1e3 * w.step_seconds());
     }},
    {[](const World& w) noexcept { return w.report().unsolved > 0; },
     [](const World& w) {
       return fmt::format(
           "backward_euler did not reach its tolerance {} time(s) in {} steps; set a smaller "
           "physics.step_ms",
           w.report().unsolved, w.report().steps);
     }},
    {[](const World& w) noexcept {
       return w.is_watched() && w.watched_ledger().balance_error() > most_balance_error;
     },
     [](const World& w) {
       const EnergyLedger ledger = w.watched_ledger();
       return fmt::format(
           "the energy does not balance: {:.2g} J of {:.2g} J exchanged, {:.2g} %, came from nowhere or got "
           "lost; what "
           "summary.json says under energy is off by that; {}",
           std::abs(ledger.missing()), ledger.exchanged, 100 * ledger.balance_error(), remedy_of_balance(w));
     }},
    {[](const World& w) noexcept {
       if (!w.is_watched()) return false;
       const EnergyLedger ledger = w.watched_ledger();
       return ledger.exchanged > EnergyLedger::negligible &&
              generated(ledger) > most_generated * ledger.exchanged;
     },
     [](const World& w) {
       const EnergyLedger ledger = w.watched_ledger();
       bool in_parts = false;
       for (std::size_t b = 0; b < w.n_bodies(); ++b)
         in_parts = in_parts || is_awake_in_parts(w.body(b).body());
       return fmt::format(
           "{} have generated {:.2g} J and contact {:.2g} J, {:.2g} % of the {:.2g} J exchanged; set a {}",
           in_parts ? "tissue that wakes and the steps" : "the steps", std::max(0.0, -ledger.numerical),
           std::max(0.0, -ledger.contact), 100 * generated(ledger) / ledger.exchanged, ledger.exchanged,
           in_parts ? "larger awake_mm" : "smaller physics.step_ms");
     }},
    {[](const World& w) noexcept {
       return w.collisions() != nullptr && w.collisions()->tally().overflows > 0;
     },
     [](const World& w) {
       return fmt::format("{} pairs of masses found no room in the contact list and were not held apart",
                          w.collisions()->tally().overflows);
     }},
    {[](const World& w) noexcept { return w.report().least_corner_J <= 0; },
     [](const World& w) {
       std::string list;
       for (std::size_t b = 0; b < w.n_bodies(); ++b)
         if (const auto least = w.body(b).counts().least_corner_J; least && *least <= 0)
           list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", w.body(b).body().name);
       return fmt::format(
           "elements of {} were turned inside out at a corner (det F down to {:.2g}): what is drawn and felt "
           "there is wrong; "
           "smaller ones, a larger tip or less depth would do",
           list, w.report().least_corner_J);
     }},
    {[](const World& w) noexcept { return w.facets_left_out() > 0; },
     [](const World& w) {
       return fmt::format(
           "{} facets that opened found no room, so that tools do not feel them; larger cells or tissue "
           "that breaks later would do",
           w.facets_left_out());
     }},
    {[](const World& w) noexcept { return faces_kept_joined(w) > 0; },
     [](const World& w) {
       return fmt::format(
           "{} faces between tetrahedra that a blade went through stayed joined, as there was no room for "
           "more "
           "nodes; coarser tetrahedra or shorter cuts would do",
           faces_kept_joined(w));
     }},
    {[](const World& w) noexcept { return !each_passed_unfelt(w, [](std::size_t, std::size_t, double) {}); },
     [](const World& w) {
       std::string list;
       each_passed_unfelt(w, [&](std::size_t n, std::size_t b, double area) {
         list += fmt::format("{}\"{}\" went through {:.0f} mm^2 of \"{}\"", list.empty() ? "" : ", ",
                             w.scene().tools[n].name, 1e6 * area, w.body(b).body().name);
       });
       return "an edge passes what it cannot cut unfelt: " + list;
     }},
};
static_assert(std::size(kinds) <= most_warning_kinds);

}  // namespace

std::string inside_text(const World& world, const InsideOthers& inside) {
  std::string list;
  for (std::size_t b = 0; b < world.n_bodies(); ++b) {
    if (inside.most(b) == 0) continue;
    list += fmt::format("{}{} of {} masses of \"{}\"", list.empty() ? "" : ", ", inside.most(b),
                        world.body(b).body().n_nodes(), world.body(b).body().name);
  }
  return fmt::format("bodies go into each other: up to {} were inside another body; {}", list, remedy(world));
}

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
