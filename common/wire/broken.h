#pragma once
// Why a sample was not let in, and which of its fields was to blame.

#include <string>

#include "common/message/messages.h"

namespace palpate {

struct Broken {
  RejectReason reason = RejectReason::other;
  const char* field = "";  // as the IDL calls it
  const char* list = "";   // that it is in an element of; empty: the message itself
  friend bool operator==(const Broken& broken, RejectReason reason) noexcept {
    return broken.reason == reason;
  }
};

/// "facets.stiffness"
std::string name_of(const Broken& broken);
/// As in "out of range".
const char* text_of(RejectReason reason) noexcept;

}  // namespace palpate
