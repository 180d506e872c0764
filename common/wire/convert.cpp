#include "common/wire/convert.h"

#include "common/wire/copy_fields.h"
#include "common/wire/judge_fields.h"

namespace palpate {
namespace {

template <class M, class Wire>
Verdict judge_fields(const Wire& wire) noexcept {
  if (wire.version != wire_version) return Broken{RejectReason::version, "version"};
  JudgeFields<Wire> judge(wire);
  M::fields(judge);
  return judge.verdict();
}

}  // namespace

#define PALPATE_CONVERSION(M)                                                            \
  Verdict judge(const palpate_wire_##M& wire) noexcept { return judge_fields<M>(wire); } \
  Verdict from_wire(const palpate_wire_##M& wire, M& message) noexcept {                 \
    const Verdict verdict = judge(wire);                                                 \
    if (!verdict) M::fields(CopyFields(wire, message));                                  \
    return verdict;                                                                      \
  }                                                                                      \
  void to_wire(const M& message, palpate_wire_##M& wire) noexcept {                      \
    wire.version = wire_version;                                                         \
    M::fields(CopyFields(message, wire));                                                \
  }
PALPATE_FOR_EACH_MESSAGE(PALPATE_CONVERSION)
#undef PALPATE_CONVERSION

}  // namespace palpate
