#pragma once
// The other processes in the DDS domain. Known from discovery alone: no topic has to match, so another
// version is seen, too.

#include <string>
#include <vector>

#include "common/wire/identity.h"
#include "common/wire/participant.h"

namespace palpate {

class Companions {
 public:
  /// @throws std::runtime_error if DDS refuses
  explicit Companions(Participant& participant);
  /// Looks through somebody else's eyes: `own` is who asks.
  Companions(Participant& participant, Identity own);
  ~Companions();
  Companions(const Companions&) = delete;
  Companions& operator=(const Companions&) = delete;

  /// The other processes of palpate that are there now. One thread; never waits.
  std::vector<Identity> present() const;

  /// Differences between the participant and its companions, one line each. A supervisor sends nothing that counts: who
  /// is in a session already need not mind that one looks in.
  std::vector<std::string> differences(bool with_supervisors) const;

  /// Other processes of our own role, where a session has room for one only: physics and haptic.
  std::vector<Identity> doubles() const;

 private:
  const Identity own_;
  std::int32_t reader_ = 0;
};

}  // namespace palpate
