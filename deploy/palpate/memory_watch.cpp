#include "deploy/palpate/memory_watch.h"

namespace palpate::deploy {

MemoryWatch::MemoryWatch(bool local)
    : local_(local),
      at_start_(local ? look_for_roudi() : RouDi::absent),
      listens_(at_start_ == RouDi::ready || at_start_ == RouDi::watching) {}

std::string MemoryWatch::news() {
  if (!local_ || at_start_ == RouDi::refused || Clock::now() < next_) return {};
  next_ = Clock::now() + std::chrono::seconds(1);
  if (!greeted_) {
    greeted_ = true;
    return at_start_ == RouDi::absent ? "" : words(at_start_);
  }
  const bool listens = roudi_listens();
  if (listens == listens_) return {};
  listens_ = listens;
  if (listens)
    return "RouDi has come; this session goes on as it began, the next one will use it if it is fit";
  if (at_start_ != RouDi::ready) return "RouDi has gone; this session never needed it";
  return "RouDi has gone: the nodes go on with the memory that they have, unless RouDi told them to end";
}

std::string MemoryWatch::last_words() {
  if (!greeted_) return {};
  next_ = Clock::now();
  return news();
}

}  // namespace palpate::deploy
