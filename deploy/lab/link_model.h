#pragma once
// A cable between two network interfaces that delays, loses and reorders, for kernels without netem.

#include <cstdint>
#include <optional>
#include <queue>
#include <random>
#include <vector>

namespace palpate::lab {

struct LinkQuality {
  double delay_ms = 0;      // each way
  double jitter_ms = 0;     // uniform, on top; frames may overtake each other
  double loss_percent = 0;  // of frames, each on its own
};

struct Frame {
  std::int64_t due_ns = 0;
  std::uint64_t number = 0;  // frames due at the same time leave in the order in which they came
  int to = 0;                // interface 0 or 1
  std::vector<std::uint8_t> bytes;
};

/// What happens to frames between coming and leaving. Knows no sockets.
class LinkModel {
 public:
  LinkModel(LinkQuality quality, std::uint64_t seed) : quality_(quality), random_(seed) {}

  void take(std::int64_t now_ns, int to, std::vector<std::uint8_t> bytes);
  /// The next frame that is due, if there is one.
  std::optional<Frame> give(std::int64_t now_ns);
  /// When the next frame will be due.
  std::optional<std::int64_t> next_due_ns() const;
  std::uint64_t taken() const noexcept { return taken_; }
  std::uint64_t lost() const noexcept { return lost_; }

 private:
  struct Later {
    bool operator()(const Frame& a, const Frame& b) const {
      return a.due_ns != b.due_ns ? a.due_ns > b.due_ns : a.number > b.number;
    }
  };
  LinkQuality quality_;
  std::mt19937_64 random_;
  std::priority_queue<Frame, std::vector<Frame>, Later> waiting_;
  std::uint64_t taken_ = 0, lost_ = 0;
};

}  // namespace palpate::lab
