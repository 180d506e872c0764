#pragma once
// What physics says to the hand: the surface under a tool, or the wrench on it and how that changes.

#include <array>
#include <cstdint>

#include "common/message/limits.h"
#include "common/message/promise.h"

namespace palpate {

/// One facet of the tissue near a tool, as a Norton-equivalent plane: where the plane would be without
/// contact force, and how stiffly the tissue behind it answers.
struct PatchFacet {
  std::array<Array3, 3> corners{};  // current positions [m]
  Array3 point{};                   // a point of the plane at zero contact force [m]
  Array3 normal{};                  // out of the tissue, unit
  Array3 velocity{};                // of the plane [m/s]
  double stiffness = 0;    // of the tissue behind the plane [N/m], > 0; rigid scenery: rigid_stiffness
  double damping = 0;      // [N s/m], >= 0
  std::uint32_t body = 0;  // index of [[body]], < max_bodies

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using namespace promise;
    visit(PALPATE_FIELD(corners), within(farthest_hand));
    visit(PALPATE_FIELD(point), within(farthest_hand));
    visit(PALPATE_FIELD(normal), unit);
    visit(PALPATE_FIELD(velocity), within(farthest_hand));
    visit(PALPATE_FIELD(stiffness), above_zero(rigid_stiffness));
    visit(PALPATE_FIELD(damping), up_to(rigid_stiffness));
    visit(PALPATE_FIELD(body), below(max_bodies));
  }
  friend bool operator==(const PatchFacet&, const PatchFacet&) = default;
};

/// A way in which tissue swings, of mass 1: q'' + damping q' + stiffness q = psi . F, F on the tissue, which psi q moves.
struct ModeOfTissue {
  Array3 psi{};          // [1 / sqrt(kg)]
  double stiffness = 0;  // omega^2 [1/s^2]
  double damping = 0;    // [1/s]
  double q = 0, w = 0;   // now: [m sqrt(kg)], and per second

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using namespace promise;
    visit(PALPATE_FIELD(psi), within(largest_shape));
    visit(PALPATE_FIELD(stiffness), up_to(stiffest_mode));
    visit(PALPATE_FIELD(damping), up_to(most_mode_damping));
    visit(PALPATE_FIELD(q), within(largest_state));
    visit(PALPATE_FIELD(w), within(largest_state));
  }
  friend bool operator==(const ModeOfTissue&, const ModeOfTissue&) = default;
};

/// What relaxes: a spring beside the modes, place' = (depth - place) / time; and a share of what the contact itself bears.
struct BranchOfTissue {
  double stiffness = 0;  // [N/m]
  double time = 1;       // > 0 [s]
  double place = 0;      // now, below the rest [m]
  double share = 0;      // of the contact, over what stays [1]
  double force = 0;      // that the contact has come to: force' = (what stays - force) / time [N]

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using namespace promise;
    visit(PALPATE_FIELD(stiffness), up_to(rigid_stiffness));
    visit(PALPATE_FIELD(time), above_zero(longest_time));
    visit(PALPATE_FIELD(place), within(farthest_hand));
    visit(PALPATE_FIELD(share), up_to(most_flow));
    visit(PALPATE_FIELD(force), up_to(strongest_tissue));
  }
  friend bool operator==(const BranchOfTissue&, const BranchOfTissue&) = default;
};

/// What a hand whose motion presses tissue can feel of it: haptic_node/tissue/tissue_model.h.
struct TouchedTissue {
  std::uint64_t sample = 0;  // ToolState.sample that the tissue has been pressed by last
  Array3 normal{0, 0, 1};    // out of the tissue, unit
  double residual = 0;       // compliance of all else, along the normal, at the first touch [m/N]
  double growth = 0;  // of the contact: residual / (1 + growth F)^(1/3) at F, see growing_contact.h [1/N]
  double residual_across = 0;  // and across it [m/N]
  Array3 arm{};                // from the hand's tip to where the tool is touched [m]
  Array3 rest{};               // place of the tip that modes and residual lie on [m]
  Array3 force{};              // on the tissue [N]
  std::uint32_t n_modes = 0;
  std::array<ModeOfTissue, max_tissue_modes> modes{};
  std::uint32_t n_branches = 0;
  std::array<BranchOfTissue, max_tissue_branches> branches{};

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using namespace promise;
    visit(PALPATE_FIELD(sample), any);
    visit(PALPATE_FIELD(normal), unit);
    visit(PALPATE_FIELD(residual), up_to(most_compliance));
    visit(PALPATE_FIELD(growth), up_to(most_growth));
    visit(PALPATE_FIELD(residual_across), up_to(most_compliance));
    visit(PALPATE_FIELD(arm), within(farthest_hand));
    visit(PALPATE_FIELD(rest), within(farthest_hand));
    visit(PALPATE_FIELD(force), within(strongest_tissue));
    visit(PALPATE_FIELD(n_modes), count(max_tissue_modes));
    visit.each(PALPATE_FIELD(modes), PALPATE_FIELD(n_modes), of_type<ModeOfTissue>);
    visit(PALPATE_FIELD(n_branches), count(max_tissue_branches));
    visit.each(PALPATE_FIELD(branches), PALPATE_FIELD(n_branches), of_type<BranchOfTissue>);
  }
  friend bool operator==(const TouchedTissue&, const TouchedTissue&) = default;
};

/// physics -> haptic. The facets that a tool may touch before the next patch. Facet 0 is the nearest one.
struct ContactPatch {
  std::uint32_t tool = 0;
  std::uint64_t tick = 0;         // counts physics frames
  std::int64_t stamp_ns = 0;      // writer's CLOCK_MONOTONIC
  std::uint64_t answers = 0;      // ToolState.tick that this answers; 0: none yet
  std::int64_t answers_ns = 0;    // ToolState.stamp_ns of that tick, echoed: loop age = now - answers_ns
  std::uint64_t contact_set = 0;  // changes when the set of facets changes
  std::uint32_t n_facets = 0;     // <= max_patch_facets; 0: free space
  std::array<PatchFacet, max_patch_facets> facets{};
  std::uint32_t n_tissues = 0;  // 1: the tool is pressed by the hand's motion
  std::array<TouchedTissue, 1> tissues{};

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using namespace promise;
    visit(PALPATE_FIELD(tool), below(max_tools));
    visit(PALPATE_FIELD(tick), any);
    visit(PALPATE_FIELD(stamp_ns), stamp);
    visit(PALPATE_FIELD(answers), any);
    visit(PALPATE_FIELD(answers_ns), stamp);
    visit(PALPATE_FIELD(contact_set), any);
    visit(PALPATE_FIELD(n_facets), count(max_patch_facets));
    visit.each(PALPATE_FIELD(facets), PALPATE_FIELD(n_facets), of_type<PatchFacet>);
    visit(PALPATE_FIELD(n_tissues), count(1));
    visit.each(PALPATE_FIELD(tissues), PALPATE_FIELD(n_tissues), of_type<TouchedTissue>);
  }
  friend bool operator==(const ContactPatch&, const ContactPatch&) = default;
};

/// physics -> haptic, render. What the tissue does to a tool, and how that changes with the pose of the hand: with M_T the
/// moment about tip,   (F, M_T)(p, q) = (F, M_T) - stiffness (p - p_WT, rotation vector from q_WT to q)
/// Where physics knows the surface beside the tool, touched or not, the hand feels that instead, as a spring that pushes only:
///   stiffness ((stretch normal, 0) - (p - p_WT, rotation vector from q_WT to q))
/// which does not follow the tissue's swinging as force and moment do.
struct ToolWrench {
  std::uint32_t tool = 0;
  std::uint64_t tick = 0;
  std::int64_t stamp_ns = 0;
  std::uint64_t answers = 0;  // as in ContactPatch
  std::int64_t answers_ns = 0;
  double t = 0;             // simulated time [s]
  Array3 p_WT{};            // pose of the hand to which force and moment belong: its tip [m]
  Array4 q_WT{1, 0, 0, 0};  // attitude, unit
  Array3 force{};           // on the tool [N]
  Array3 moment{};          // on the tool, about set_point [N m]
  Array3 set_point{};       // [m]
  Array3 tip{};  // of the tool, which M_T is about [m]; elsewhere than p_WT if the hand took it there
  std::array<double, 36>
      stiffness{};               // local 6x6, symmetric, row major [N/m, N, N m/rad]; zero: not computed
  Array3 normal{};               // out of the tissue, unit; zero: no surface is known
  double stretch = 0;            // of the spring at p_WT, q_WT; below 0: the way that is left to contact [m]
  std::uint32_t n_contacts = 0;  // colliding masses

  template <class Visit>
  static constexpr void fields(Visit&& visit) {
    using namespace promise;
    visit(PALPATE_FIELD(tool), below(max_tools));
    visit(PALPATE_FIELD(tick), any);
    visit(PALPATE_FIELD(stamp_ns), stamp);
    visit(PALPATE_FIELD(answers), any);
    visit(PALPATE_FIELD(answers_ns), stamp);
    visit(PALPATE_FIELD(t), up_to(longest_time));
    visit(PALPATE_FIELD(p_WT), within(farthest_hand));
    visit(PALPATE_FIELD(q_WT), unit);
    visit(PALPATE_FIELD(force), within(strongest_tissue));
    visit(PALPATE_FIELD(moment), within(strongest_tissue));
    visit(PALPATE_FIELD(set_point), within(farthest_hand));
    visit(PALPATE_FIELD(tip), within(farthest_hand));
    visit(PALPATE_FIELD(stiffness), within(rigid_stiffness));
    visit(PALPATE_FIELD(normal), unit_or_zero);
    visit(PALPATE_FIELD(stretch), within(farthest_hand));
    visit(PALPATE_FIELD(n_contacts), any);
  }
  friend bool operator==(const ToolWrench&, const ToolWrench&) = default;
};

}  // namespace palpate
