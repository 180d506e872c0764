#pragma once
// A 3-D mouse behind spacenavd, as a device without motors: how far its cap is pushed is how fast the handle moves.
//
//   x' = s d_t,   R' = [s_r d_r]x R       d_t, d_r the deflections, 1 at full_deflection counts; s, s_r full speeds
//
// so that the handle stays where it is when the cap is released. A thread listens to the daemon; the path is
// summed up in read(), in the host's clock.

#include <Eigen/Geometry>
#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

#include "common/exchange/triple_buffer.h"
#include "haptic_node/drivers/kit/driver.h"

namespace palpate::haptic::spacenav {

struct Settings {
  double speed = 0.05;           // at full deflection [m/s]
  double turn = 1.0;             // [rad/s]
  double half_workspace = 0.15;  // a cube about the origin, which the handle does not leave [m]
};

class SpacenavDevice final : public kit::OpenDevice {
 public:
  static constexpr double full_deflection = 350;  // counts of the daemon with its own settings
  static constexpr double longest_step = 0.02;    // a longer absence of the host moves nothing more [s]

  /// libspnav knows one connection in a process. @throws kit::Trouble
  SpacenavDevice(const hdev_host& host, const Settings& settings);
  ~SpacenavDevice() override;

  void fill(hdev_info& info) const override;
  void power(bool on) override;
  std::string last_words() const override;
  hdev_status read(hdev_state& state) noexcept override;
  hdev_status write(const kit::Effort& effort) noexcept override;
  hdev_status stop() noexcept override { return HDEV_OK; }

 private:
  struct Deflection {
    std::array<double, 6> d{};  // 1: full
    std::uint32_t buttons = 0;
  };
  void listen() noexcept;
  bool take_events(Deflection& now) noexcept;

  Settings settings_;
  TripleBuffer<Deflection> deflections_;  // listener -> host's thread
  std::atomic<bool> leaving_{false}, lost_{false};
  // Host's thread:
  Eigen::Vector3d x_ = Eigen::Vector3d::Zero();
  Eigen::Quaterniond q_ = Eigen::Quaterniond::Identity();
  std::int64_t last_ns_ = 0;
  std::uint64_t seq_ = 0;
  std::thread listener_;
};

}  // namespace palpate::haptic::spacenav
