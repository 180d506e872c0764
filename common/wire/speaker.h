#pragma once
// Who may publish. DDS lets every process of a domain write to every topic; a node accepts one process for
// each thing that only one can know, and counts the samples of others without reading them.
//
// A process that claims the role, in this scene and this version, takes precedence over one that claims none
// (tools, tests), and keeps its place while it publishes. After a silence, or when it has ended, the next one
// takes the place. A process that claims another role is never accepted. This keeps out mistakes; only DDS
// Security keeps out a process that lies.

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "common/wire/identity.h"
#include "common/wire/participant.h"

namespace palpate {

class Speaker {
 public:
  /// One process at a time.
  /// @param role      physics or haptic
  /// @param patience  silence after which another process may take its place
  Speaker(const Participant& participant, const std::string& role, std::chrono::nanoseconds patience);
  /// Every process whose role is among these, and every one that claims none.
  Speaker(const Participant& participant, std::vector<std::string> roles);
  Speaker(const Speaker&) = delete;
  Speaker& operator=(const Speaker&) = delete;

  /// How often another process took the place; 1 from the first on. Any thread.
  std::uint64_t changes() const noexcept { return changes_.load(std::memory_order_acquire); }

  /// What a person should know and has not been shown: one line for each process that is refused, and for
  /// each that takes a place; the first hundred. Any thread.
  std::vector<std::string> remarks();

  // For common/wire only.

  /// Of threads of DDS, before a sample takes the place of another one. @return false: it is foreign
  bool may_pass(std::uint64_t publication) noexcept;
  /// Of the one thread that takes samples, of all topics on which this speaker speaks. Nothing allocates, but for a
  /// publication that was never heard before.
  /// @param reader, publication  handles of DDS
  bool admits(std::int32_t reader, const char* topic, std::uint64_t publication);
  /// Why the last sample was not admitted.
  const std::string& why_not() const noexcept { return why_not_; }

 private:
  enum class Rank { stranger, unnamed, member };
  struct Known {
    std::uint64_t publication = 0;
    std::array<std::uint8_t, 16> process{};  // of its DDS participant
    std::optional<Identity> identity;
    Rank rank = Rank::unnamed;
    bool told = false;
  };
  static constexpr std::size_t most_known = 64;

  Known* find(std::int32_t reader, std::uint64_t publication);
  Rank rank_of(const std::optional<Identity>& identity) const;
  bool may_speak(const Known& who);
  bool is_foreign(std::uint64_t publication) const noexcept;
  void refuse(Known* who, const char* topic, std::uint64_t publication);
  void remark(std::string line);
  std::int64_t silence_ns() const noexcept;

  const Identity own_;
  const std::vector<std::string> roles_;
  const std::int64_t patience_ns_;  // 0: many may speak

  std::array<Known, most_known> known_;  // a ring: whoever makes thousands of writers makes us ask DDS again
  std::size_t next_known_ = 0;
  std::optional<Known> current_;
  std::string why_not_;
  std::array<std::atomic<std::uint64_t>, most_known> foreign_{};  // publications; a ring; 0: none
  std::size_t next_foreign_ = 0;
  std::atomic<std::int64_t> came_ns_{0};   // a sample that is not foreign, to DDS
  std::atomic<std::int64_t> heard_ns_{0};  // one was taken
  std::atomic<std::int64_t> looked_ns_{
      0};  // when may_pass last let a foreign one through, to be looked at again
  std::atomic<std::uint64_t> changes_{0};

  std::mutex mutex_;  // of both
  std::vector<std::string> remarks_;
  int n_remarks_ = 0;
};

}  // namespace palpate
