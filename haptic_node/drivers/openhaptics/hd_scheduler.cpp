#include "haptic_node/drivers/openhaptics/hd_scheduler.h"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <mutex>

#include "haptic_node/drivers/kit/driver.h"
#include "haptic_node/drivers/openhaptics/hd_errors.h"

namespace palpate::haptic::openhaptics {
namespace {

std::mutex& gate() {
  static std::mutex mutex;
  return mutex;
}

/// Devices in use of each library; behind the gate.
int& n_open(const Hd& hd) {
  static std::map<const Hd*, int> count;
  return count[&hd];
}

/// The scheduler rests while this lives.
class Rest {
 public:
  explicit Rest(const Hd& hd) : hd_(hd), lock_(gate()) {
    if (n_open(hd_) > 0) hd_.stop_scheduler();
  }
  ~Rest() {
    if (n_open(hd_) > 0) hd_.start_scheduler();
  }
  Rest(const Rest&) = delete;
  Rest& operator=(const Rest&) = delete;

 private:
  const Hd& hd_;
  std::lock_guard<std::mutex> lock_;
};

}  // namespace

const Hd& shared_hd(const std::string& file) {
  static std::map<std::string, std::unique_ptr<Hd>> loaded;
  const std::lock_guard<std::mutex> lock(gate());
  auto& hd = loaded[file];
  if (!hd) hd = std::make_unique<Hd>(file);
  return *hd;
}

void open_scheduled(const Hd& hd, const std::string& name, unsigned long rate_Hz, HDCallback frame,
                    void* user, void (*prepare)(void* user), ScheduledDevice& opened) {
  const Rest rest(hd);
  forget_errors(hd);
  opened.device = hd.init_device(name.c_str());
  const HDErrorInfo error = hd.get_error();
  if (error.code != HD_SUCCESS || opened.device == HD_INVALID_HANDLE) {
    if (opened.device != HD_INVALID_HANDLE) hd.disable_device(opened.device);
    throw open_trouble(hd, name, error);
  }
  try {
    hd.make_current(opened.device);
    prepare(user);
    hd.set_scheduler_rate(rate_Hz);
    if (const HDErrorInfo refused = hd.get_error(); refused.code != HD_SUCCESS)
      throw kit::Trouble(
          HDEV_E_ARG, fmt::format("the scheduler does not run at {} Hz: {}; 500 and 1000 are usual", rate_Hz,
                                  words_of(hd, refused)));
    opened.frame = hd.schedule_asynchronous(frame, user, HD_MAX_SCHEDULER_PRIORITY);
    if (const HDErrorInfo refused = hd.get_error(); refused.code != HD_SUCCESS)
      throw kit::Trouble(HDEV_E_BUSY, "the scheduler takes no callback: " + words_of(hd, refused));
  } catch (...) {
    hd.disable_device(opened.device);
    throw;
  }
  ++n_open(hd);
}

void close_scheduled(const Hd& hd, const ScheduledDevice& device, const std::function<bool()>& last_act) {
  const Rest rest(hd);
  hd.unschedule(device.frame);
  hd.make_current(device.device);
  if (last_act()) hd.disable_device(device.device);
  --n_open(hd);
  forget_errors(hd);
}

}  // namespace palpate::haptic::openhaptics
