#pragma once
// What a process can do to be on time every millisecond. Each step may be refused; a refusal is reported, not hidden.

#include <string>

namespace palpate::haptic {

struct RealtimeRights {
  bool locked = false;     // pages stay in memory (mlockall)
  bool scheduled = false;  // SCHED_FIFO
  bool all() const noexcept { return locked && scheduled; }
};

/// For the whole process, before threads start: memory locked, or why not.
/// @param why  one line when refused, else unchanged
bool lock_memory(std::string& why);

/// Whether SCHED_FIFO of this priority may be had: tried on the calling thread and undone.
bool may_schedule(int priority, std::string& why);

/// For the calling thread: SCHED_FIFO of `priority`, 512 KiB of stack touched, denormals taken as zero.
/// @return whether SCHED_FIFO was granted; the rest always works
bool enter_realtime(int priority) noexcept;

/// "rt: fifo=yes mlock=no"
std::string rights_text(const RealtimeRights& rights);

}  // namespace palpate::haptic
