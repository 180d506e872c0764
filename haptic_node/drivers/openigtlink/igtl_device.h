#pragma once
// A tool that a tracking system follows, as a device without motors. A thread of its own listens to the tracker server;
// poses wait for the host's thread in a triple buffer.

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>

#include "common/exchange/triple_buffer.h"
#include "haptic_node/drivers/kit/driver.h"
#include "haptic_node/drivers/kit/tcp_stream.h"
#include "haptic_node/drivers/openigtlink/igtl_reader.h"

namespace palpate::haptic::openigtlink {

struct Settings {
  std::string host = "localhost";
  std::string port = "18944";
  double half_workspace = 0.5;  // a cube about the tracker's origin [m]
};

class IgtlDevice final : public kit::OpenDevice {
 public:
  static constexpr std::chrono::milliseconds first_pose_time{2000};

  /// Waits for the first pose. @param id  name of the tool; empty: the first one that is heard of
  /// @throws kit::Trouble
  IgtlDevice(const hdev_host& host, const Settings& settings, const std::string& id);
  ~IgtlDevice() override;

  void fill(hdev_info& info) const override;
  void power(bool on) override;
  std::string last_words() const override;
  hdev_status read(hdev_state& state) noexcept override;
  hdev_status write(const kit::Effort&) noexcept override { return HDEV_E_UNSUPPORTED; }
  hdev_status stop() noexcept override { return HDEV_OK; }

 private:
  void listen() noexcept;
  bool take_poses();
  void publish(const TrackedPose& pose) noexcept;

  Settings settings_;
  std::string id_;
  kit::TcpStream stream_;
  IgtlReader reader_;
  TripleBuffer<hdev_state> samples_;  // listener -> host's thread
  std::atomic<bool> leaving_{false}, lost_{false};
  std::string lost_words_;      // written before lost_ is set, read after
  std::uint64_t seq_ = 0;       // listener's
  std::uint64_t last_seq_ = 0;  // host's
  std::thread listener_;
};

}  // namespace palpate::haptic::openigtlink
