#pragma once
// Why a sample was not let in, and which of its fields was to blame.

#include "common/message/messages.h"

namespace palpate {

struct Broken {
  RejectReason reason = RejectReason::other;
  const char* field = "";  // as the IDL calls it
  friend bool operator==(const Broken& broken, RejectReason reason) noexcept {
    return broken.reason == reason;
  }
};

/// As in "out of range".
const char* text_of(RejectReason reason) noexcept;

}  // namespace palpate
