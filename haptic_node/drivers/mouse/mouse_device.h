#pragma once
// The mouse in the render window, as a device that is held while the person has taken the tool. A thread of its own
// listens for Pointer; the newest waits for the host's thread in a triple buffer. Forces are shown, not felt: the device
// takes them, so that tissue gives way, and no motor pushes the hand back.

#include <Eigen/Geometry>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>

#include "common/exchange/triple_buffer.h"
#include "common/message/messages.h"
#include "common/wire/participant.h"
#include "common/wire/reader.h"
#include "haptic_node/drivers/kit/driver.h"
#include "haptic_node/drivers/mouse/pointer_follower.h"

namespace palpate::haptic::mouse {

struct Settings {
  int domain = 0;          // DDS
  std::uint32_t tool = 0;  // whose Pointer counts
  Eigen::Matrix3d rotation =
      Eigen::Matrix3d::Identity();  // pointers are in the world, samples in the device's frame:
  double scale = 1.0;               //   x_d = R^T (p - o) / s
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  // o [m]
  double speed = 0.5;                                // fastest handle, in the world [m/s]
  double max_force = 20.0;                           // [N]
};

class MouseDevice final : public kit::OpenDevice {
 public:
  /// A window that says nothing for so long has gone: it sends with every picture.
  static constexpr std::int64_t silence_ns = 500'000'000;
  static constexpr double longest_step = 0.02;  // a longer absence of the host moves nothing more [s]

  /// @throws what Participant throws
  MouseDevice(const hdev_host& host, const Settings& settings);
  ~MouseDevice() override;

  void fill(hdev_info& info) const override;
  void power(bool on) override { powered_.store(on); }
  std::string last_words() const override;
  /// HDEV_E_AGAIN before the window has said anything, and when it has gone; it may return.
  hdev_status read(hdev_state& state) noexcept override;
  hdev_status write(const kit::Effort& effort) noexcept override;
  hdev_status stop() noexcept override;

 private:
  struct Heard {
    Pointer pointer;
    std::int64_t t_ns = 0;  // of its arrival, in the host's clock
  };
  void listen() noexcept;

  Settings settings_;
  Participant participant_;
  Speaker speaker_;  // one window moves the hand
  Reader<Pointer> pointers_;
  TripleBuffer<Heard> heard_;  // listener -> host's thread
  std::atomic<bool> leaving_{false}, window_{false}, powered_{false};
  // Host's thread:
  PointerFollower follower_;
  bool began_ = false;
  std::int64_t last_ns_ = 0;
  std::uint64_t seq_ = 0;
  double force_[3]{};
  std::thread listener_;
};

}  // namespace palpate::haptic::mouse
