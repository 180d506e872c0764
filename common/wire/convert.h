#pragma once
// Between what travels (idl/palpate.idl) and what the nodes work with (common/message/messages.h). For common/wire and
// its tests only.
//
// The one door for numbers: judge() looks at everything a message promises and names the first promise broken; a sample
// with a broken promise is never turned into a message. Text must end within its array; arrays matter up to their counts
// only; every number is finite and within the limits of messages.h; directions and quaternions are of length one within 1e-3.

#include <optional>

#include "common/message/messages.h"
#include "common/wire/broken.h"
#include "idl/palpate.h"

namespace palpate {

using Verdict = std::optional<Broken>;  // nothing: the sample keeps all promises

Verdict judge(const palpate_wire_ToolState& wire) noexcept;
Verdict judge(const palpate_wire_ContactPatch& wire) noexcept;
Verdict judge(const palpate_wire_ToolWrench& wire) noexcept;
Verdict judge(const palpate_wire_BodySurface& wire) noexcept;
Verdict judge(const palpate_wire_SurfaceChange& wire) noexcept;
Verdict judge(const palpate_wire_VertexBlock& wire) noexcept;
Verdict judge(const palpate_wire_HapticTrace& wire) noexcept;
Verdict judge(const palpate_wire_Pointer& wire) noexcept;
Verdict judge(const palpate_wire_Command& wire) noexcept;
Verdict judge(const palpate_wire_NodeStatus& wire) noexcept;

/// Judges, and if nothing is wrong writes `message` (array elements beyond the counts keep what they held).
/// A rejected sample leaves `message` as it was.
Verdict from_wire(const palpate_wire_ToolState& wire, ToolState& message) noexcept;
Verdict from_wire(const palpate_wire_ContactPatch& wire, ContactPatch& message) noexcept;
Verdict from_wire(const palpate_wire_ToolWrench& wire, ToolWrench& message) noexcept;
Verdict from_wire(const palpate_wire_BodySurface& wire, BodySurface& message) noexcept;
Verdict from_wire(const palpate_wire_SurfaceChange& wire, SurfaceChange& message) noexcept;
Verdict from_wire(const palpate_wire_VertexBlock& wire, VertexBlock& message) noexcept;
Verdict from_wire(const palpate_wire_HapticTrace& wire, HapticTrace& message) noexcept;
Verdict from_wire(const palpate_wire_Pointer& wire, Pointer& message) noexcept;
Verdict from_wire(const palpate_wire_Command& wire, Command& message) noexcept;
Verdict from_wire(const palpate_wire_NodeStatus& wire, NodeStatus& message) noexcept;

/// Writes `wire`, elements up to the counts; no judgement.
void to_wire(const ToolState& message, palpate_wire_ToolState& wire) noexcept;
void to_wire(const ContactPatch& message, palpate_wire_ContactPatch& wire) noexcept;
void to_wire(const ToolWrench& message, palpate_wire_ToolWrench& wire) noexcept;
void to_wire(const BodySurface& message, palpate_wire_BodySurface& wire) noexcept;
void to_wire(const SurfaceChange& message, palpate_wire_SurfaceChange& wire) noexcept;
void to_wire(const VertexBlock& message, palpate_wire_VertexBlock& wire) noexcept;
void to_wire(const HapticTrace& message, palpate_wire_HapticTrace& wire) noexcept;
void to_wire(const Pointer& message, palpate_wire_Pointer& wire) noexcept;
void to_wire(const Command& message, palpate_wire_Command& wire) noexcept;
void to_wire(const NodeStatus& message, palpate_wire_NodeStatus& wire) noexcept;

}  // namespace palpate
