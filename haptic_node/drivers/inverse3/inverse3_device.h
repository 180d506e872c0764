#pragma once
// One Inverse3 behind the Haply Inverse service. A thread of its own speaks with the service, which answers each message
// with one state; the host's thread meets it in two triple buffers and never sees a socket or a text.

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "common/exchange/triple_buffer.h"
#include "haptic_node/drivers/inverse3/haply_message.h"
#include "haptic_node/drivers/inverse3/websocket.h"
#include "haptic_node/drivers/kit/driver.h"

namespace palpate::haptic::inverse3 {

struct Settings {
  std::string host = "localhost";
  std::string port = "10001";
  Dialect dialect;
  double rate_Hz = 1000;     // messages a second
  double max_force = 4;      // [N]
  double max_stiffness = 0;  // [N/m]; 0: the scene's
};

/// The devices that the service has now. @throws kit::Trouble
std::vector<std::string> list_devices(const Settings& settings);

/// No force, over a connection of its own: for another process, after the one that led the device has died.
/// @throws kit::Trouble
void rescue_device(const Settings& settings, const std::string& id);

class Inverse3Device final : public kit::OpenDevice {
 public:
  static constexpr std::int64_t silence_ns = 20'000'000;        // of the host, after which the force is none
  static constexpr std::chrono::milliseconds answer_time{200};  // a service that takes longer is gone
  static constexpr int bad_answers_to_lost = 20;                // in a row
  /// Answers in a row that tell of no force at all while at least so much is sent. Why: 100 ms; filters of the service delay and
  /// scale a force, they do not swallow it.
  static constexpr int nothings_to_fault = 100;
  static constexpr double certain_force = 0.2;  // [N]

  /// @throws kit::Trouble
  Inverse3Device(const hdev_host& host, const Settings& settings, const std::string& id);
  ~Inverse3Device() override;

  void fill(hdev_info& info) const override;
  void power(bool on) override;
  std::string last_words() const override;
  hdev_status read(hdev_state& state) noexcept override;
  hdev_status write(const kit::Effort& effort) noexcept override;
  hdev_status stop() noexcept override;
  hdev_status emergency_stop(std::uint32_t within_us) noexcept override;
  bool motors_are_off() const noexcept override { return !forcing_.load(); }

 private:
  struct Sample {
    hdev_state state{};
    hdev_status status = HDEV_OK;
  };
  struct Order {
    std::array<double, 3> force{};
    std::int64_t t_ns = 0;
  };
  void converse() noexcept;
  bool exchange(bool first);
  std::array<double, 3> force_due() noexcept;
  void publish(hdev_status status, const std::array<double, 3>& force, bool powered) noexcept;
  void look_for_faults(const HaplyState& before, const std::array<double, 3>& force) noexcept;
  void fault(std::uint32_t bit, const char* why) noexcept;

  Settings settings_;
  std::string id_;
  WebSocket socket_;
  bool has_grip_ = false;         // when it was opened
  HaplyState known_;              // conversation's, once it has begun
  TripleBuffer<Sample> samples_;  // conversation -> host's thread
  TripleBuffer<Order> orders_;    // host's thread -> conversation
  std::atomic<bool> wanted_{false}, leaving_{false}, lost_{false};
  std::atomic<bool> doomed_{false};           // the process is dying: no force any more
  std::atomic<bool> forcing_{false};          // the last message held a force, perhaps none
  std::string no_force_;                      // the message that ends a force, ready to be sent
  std::string lost_words_;                    // written before lost_ is set, read after
  std::atomic<const char*> fault_words_{""};  // static text
  // Host's thread:
  std::uint64_t last_seq_ = 0;
  // Conversation:
  std::uint64_t seq_ = 0;
  int bad_in_a_row_ = 0;
  std::uint32_t fault_ = 0;
  bool has_applied_ = false;  // it has told of a force
  int nothings_in_a_row_ = 0;
  std::thread thread_;
};

}  // namespace palpate::haptic::inverse3
