#pragma once
// What the three nodes tell each other, as plain SI structs. common/wire carries them over DDS and rejects
// whole any sample that breaks the promises written here. idl/README.md has writers, readers, rates and QoS.
//
// World frame everywhere, metres, newtons, seconds. Quaternions are (w, x, y, z). Text is zero-terminated.
// All structs are trivially copyable, so that they pass through lock-free buffers and shared memory.
//
// fields() of a struct names every member once, in the order of idl/palpate.idl, with its promise (promise.h). Conversion, checks and
// the tests' samples follow from it.

#include "common/message/contact_messages.h"
#include "common/message/hand_messages.h"
#include "common/message/limits.h"
#include "common/message/node_messages.h"
#include "common/message/surface_messages.h"
