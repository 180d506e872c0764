#pragma once
// The last ten seconds of one tool at full rate, kept for the moment when something goes wrong. All memory is taken
// when it is made; the real-time thread only writes into it.
//
// Two rings: after a trigger the one in use goes on for after_s, then is kept as it is for the slow thread, and the other
// one takes over. A trigger that comes while one is kept is counted, not kept.

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "haptic_node/control/controller.h"
#include "haptic_node/session.h"

namespace palpate::haptic {

struct FlightSample {
  TraceSample trace;
  Array4 q_WT{1, 0, 0, 0};  // attitude of the handle, unit
  HapticState state = HapticState::off;
  double surplus = 0;    // [J]
  double patch_age = 0;  // since the newest patch was first used; below 0: never [s]
};

class FlightRecorder {
 public:
  static constexpr double kept_s = 10;
  static constexpr double after_s = 0.2;

  explicit FlightRecorder(double rate_Hz);

  /// Real-time thread. @{
  void add(const FlightSample& sample) noexcept;
  void trigger() noexcept;  // what is running becomes a flight to keep
  /// @}

  /// Slow thread: writes the kept flight, oldest sample first, if there is one.
  ///   t_s,state,x_m,y_m,z_m,qw,qx,qy,qz,proxy_x_m,proxy_y_m,proxy_z_m,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,energy_J,surplus_J,
  ///   patch_age_s                               force and moment are those on the hand, the moment about the tip, all in the world
  /// @param path  of the file; one that exists is replaced
  /// @return whether there was one. @throws InputError if it cannot be written
  bool write_kept(const std::string& path);
  bool has_kept() const noexcept { return kept_.load(std::memory_order_acquire) >= 0; }
  std::uint64_t dropped() const noexcept { return dropped_.load(); }

  /// After the real-time thread has ended: a trigger need not wait for after_s any longer.
  void end() noexcept;

 private:
  struct Ring {
    std::vector<FlightSample> samples;
    std::uint64_t n = 0;
  };
  void keep() noexcept;

  std::array<Ring, 2> rings_;
  int running_ = 0;  // the real-time thread's
  std::uint64_t after_ticks_;
  std::uint64_t left_ = 0;  // ticks until the running ring is kept; 0: no trigger
  std::atomic<int> kept_{-1};
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace palpate::haptic
