#include "common/wire/convert.h"
#include "common/wire/convert_parts.h"

namespace palpate {

using namespace wire_parts;

namespace {

Verdict judge_facet(const palpate_wire_PatchFacet& wire) noexcept {
  return Check()
      .that(wire.body < max_bodies, RejectReason::unknown_id, "facets.body")
      .bounded(wire.corners, farthest_hand, "facets.corners")
      .bounded(wire.point, farthest_hand, "facets.point")
      .unit(wire.normal, "facets.normal")
      .bounded(wire.velocity, farthest_hand, "facets.velocity")
      .positive(wire.stiffness, rigid_stiffness, "facets.stiffness")
      .that(wire.stiffness > 0, RejectReason::out_of_range, "facets.stiffness")
      .positive(wire.damping, rigid_stiffness, "facets.damping")
      .verdict();
}

}  // namespace

Verdict judge(const palpate_wire_ContactPatch& wire) noexcept {
  const Verdict head = Check(wire.version)
                           .that(wire.tool < max_tools, RejectReason::unknown_id, "tool")
                           .that(wire.n_facets <= max_patch_facets, RejectReason::count, "n_facets")
                           .stamp(wire.stamp_ns, "stamp_ns")
                           .stamp(wire.answers_ns, "answers_ns")
                           .verdict();
  if (head) return head;
  for (std::uint32_t i = 0; i < wire.n_facets; ++i) {
    if (const Verdict verdict = judge_facet(wire.facets[i])) return verdict;
  }
  return {};
}

Verdict from_wire(const palpate_wire_ContactPatch& wire, ContactPatch& message) noexcept {
  if (const Verdict verdict = judge(wire)) return verdict;
  message.tool = wire.tool;
  message.tick = wire.tick;
  message.stamp_ns = wire.stamp_ns;
  message.answers = wire.answers;
  message.answers_ns = wire.answers_ns;
  message.contact_set = wire.contact_set;
  message.n_facets = wire.n_facets;
  for (std::uint32_t i = 0; i < wire.n_facets; ++i) {
    const palpate_wire_PatchFacet& from = wire.facets[i];
    PatchFacet& to = message.facets[i];
    copy(from.corners, to.corners);
    copy(from.point, to.point);
    copy(from.normal, to.normal);
    copy(from.velocity, to.velocity);
    to.stiffness = from.stiffness;
    to.damping = from.damping;
    to.body = from.body;
  }
  return {};
}

void to_wire(const ContactPatch& message, palpate_wire_ContactPatch& wire) noexcept {
  wire.version = wire_version;
  wire.tool = message.tool;
  wire.tick = message.tick;
  wire.stamp_ns = message.stamp_ns;
  wire.answers = message.answers;
  wire.answers_ns = message.answers_ns;
  wire.contact_set = message.contact_set;
  wire.n_facets = message.n_facets;
  for (std::uint32_t i = 0; i < std::min(message.n_facets, max_patch_facets); ++i) {
    const PatchFacet& from = message.facets[i];
    palpate_wire_PatchFacet& to = wire.facets[i];
    copy(from.corners, to.corners);
    copy(from.point, to.point);
    copy(from.normal, to.normal);
    copy(from.velocity, to.velocity);
    to.stiffness = from.stiffness;
    to.damping = from.damping;
    to.body = from.body;
  }
}

}  // namespace palpate
