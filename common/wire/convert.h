#pragma once
// Between what travels (idl/palpate.idl) and what the nodes work with (common/message/messages.h). For common/wire and
// its tests only.
//
// The one door for numbers: judge() looks at everything a message promises in its fields() and names the first promise broken; a
// sample with a broken promise is never turned into a message. Text must end within its array; arrays matter up to their counts
// only; every number is finite and within the limits of messages.h; directions and quaternions are of length one within 1e-3.

#include <optional>

#include "common/message/messages.h"
#include "common/wire/broken.h"
#include "idl/palpate.h"

namespace palpate {

inline constexpr std::uint32_t wire_version = palpate_wire_version_of_all;

using Verdict = std::optional<Broken>;  // nothing: the sample keeps all promises

/// All messages, for what is written once for each.
#define PALPATE_FOR_EACH_MESSAGE(DO) \
  DO(ToolState)                      \
  DO(ContactPatch)                   \
  DO(ToolWrench)                     \
  DO(BodySurface) DO(SurfaceChange) DO(VertexBlock) DO(HapticTrace) DO(Pointer) DO(Command) DO(NodeStatus)

/// from_wire() judges, and if nothing is wrong writes `message` (array elements beyond the counts keep what they held). A
/// rejected sample leaves `message` as it was. to_wire() writes elements up to the counts; no judgement.
#define PALPATE_CONVERSION(M)                                           \
  Verdict judge(const palpate_wire_##M& wire) noexcept;                 \
  Verdict from_wire(const palpate_wire_##M& wire, M& message) noexcept; \
  void to_wire(const M& message, palpate_wire_##M& wire) noexcept;
PALPATE_FOR_EACH_MESSAGE(PALPATE_CONVERSION)
#undef PALPATE_CONVERSION

}  // namespace palpate
