#pragma once
// One direction of a network, in simulated time: delay, jitter, loss, duplicates, reordering, gaps.

#include <algorithm>
#include <cstdint>
#include <queue>
#include <random>
#include <utility>
#include <vector>

namespace palpate::bench {

struct LinkModel {
  double delay = 0;      // one way [s]
  double jitter = 0;     // added, uniform in [0, jitter] [s]; more than a period apart reorders
  double loss = 0;       // probability
  double duplicate = 0;  // probability that a message comes twice, each with a jitter of its own
  double gap = 0;        // once a second nothing is carried for so long, then all of it at once [s]
};

template <class T>
class Link {
 public:
  Link(const LinkModel& model, std::uint64_t seed) : model_(model), random_(seed) {}

  void send(std::int64_t now_ns, const T& message) {
    ++sent_;
    const int copies = chance(model_.duplicate) ? 2 : 1;
    for (int i = 0; i < copies; ++i) {
      if (chance(model_.loss)) continue;
      double late = model_.delay + held_up(now_ns);
      if (model_.jitter > 0) late += model_.jitter * uniform_(random_);
      queue_.push({now_ns + static_cast<std::int64_t>(late * 1e9), sent_, message});
    }
  }

  /// Takes all that has arrived; the last to arrive is left in `message`, which need not be the newest sent.
  /// @return true if any has
  bool receive(std::int64_t now_ns, T& message) {
    bool any = false;
    while (!queue_.empty() && queue_.top().arrives <= now_ns) {
      message = queue_.top().message;
      queue_.pop();
      any = true;
    }
    return any;
  }

 private:
  struct Packet {
    std::int64_t arrives;
    std::uint64_t number;
    T message;
    bool operator<(const Packet& other) const {
      return arrives != other.arrives ? arrives > other.arrives : number > other.number;
    }
  };

  /// Until the end of a gap [s].
  double held_up(std::int64_t now_ns) const {
    const double since = 1e-9 * static_cast<double>(now_ns % 1'000'000'000);
    return std::max(0.0, model_.gap - since);
  }
  bool chance(double probability) { return probability > 0 && uniform_(random_) < probability; }

  LinkModel model_;
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> uniform_{0, 1};
  std::uint64_t sent_ = 0;
  std::priority_queue<Packet> queue_;
};

}  // namespace palpate::bench
