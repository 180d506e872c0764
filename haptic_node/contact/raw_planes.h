#pragma once
// The newest planes as they come, and the force of physics as it comes: what the papers do. Kept by name, so that what
// they cost can be felt and measured; neither bounds the energy that late tissue gives to a hand.
//
//   raw planes:  F = K d n - B v_n on the deepest facet      (Mendoza & Laugier: planes at the rate of physics)
//   direct:      F = what physics computed last, held        (Takada, Abe et al.)

#include "common/message/messages.h"
#include "haptic_node/contact/contact_result.h"
#include "haptic_node/contact/hand_motion.h"

namespace palpate::haptic {

/// On the deepest of the facets whose way in is the shortest: facet 0. Not below zero, not above `limit`.
ContactResult raw_plane_force(const ContactPatch& patch, const HandMotion& hand, double stiffness,
                              double damping, double limit) noexcept;

/// The wrench of physics, its moment moved to the tip.
ContactResult direct_force(const ToolWrench& wrench, const HandMotion& hand, double stiffness) noexcept;

}  // namespace palpate::haptic
