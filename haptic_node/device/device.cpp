#include "haptic_node/device/device.h"

#include <fmt/format.h>
#include <time.h>

#include <cmath>
#include <cstdio>
#include <thread>

#include "common/error/error.h"

namespace palpate::haptic {
namespace {

constexpr std::uint32_t calibration_timeout_ms = 10'000;
constexpr timespec grace{0, 5'000'000};  // for a thread that stop() of an older driver has only woken

void log_line(void*, int level, const char* line) {
  std::fprintf(stderr, "haptic device %s: %s\n", level >= 2 ? "error" : level == 1 ? "warn" : "info", line);
}

/// What is not credible in what a device says about itself; empty: nothing.
std::string objection(const hdev_info& info) {
  if ((info.caps & HDEV_CAP_POS) == 0) return "the device measures no position";
  for (const double value : {info.max_force, info.cont_force, info.max_stiffness, info.apparent_mass})
    if (!std::isfinite(value) || value < 0) return "the device states a force, stiffness or mass below zero";
  if ((info.caps & HDEV_CAP_FORCE) != 0 && info.max_force <= 0)
    return "the device has motors but states no force";
  return {};
}

}  // namespace

Device::Device(const DriverLibrary& library, const Options& options, ClockFunction now_ns, void* user,
               const std::string& place)
    : api_(&library.api()), name_(library.name()), host_(std::make_shared<hdev_host>()) {
  host_->size = sizeof(hdev_host);
  host_->user = user;
  host_->log = &log_line;
  host_->now_ns = now_ns;

  words_ = {library.name(), library.path(), {}, {}, false};
  for (const auto& [key, value] : options) {
    if (key == "id")
      words_.id = value;
    else
      words_.pairs.insert(words_.pairs.end(), {key, value});
  }
  std::vector<const char*> kv;
  for (const auto& word : words_.pairs) kv.push_back(word.c_str());
  const auto refuse = [&](const std::string& what) {
    throw InputError(
        fmt::format("{}{}driver \"{}\": {}", place, place.empty() ? "" : ": ", library.name(), what));
  };
  const auto refuse_open = [&](const std::string& what) {
    close();
    refuse(what);
  };

  const auto pairs = static_cast<std::uint32_t>(kv.size() / 2);
  if (api_->open(host_.get(), words_.id.c_str(), kv.data(), pairs, &handle_) != HDEV_OK ||
      handle_ == nullptr) {
    handle_ = nullptr;
    refuse(api_->last_error(nullptr));
  }
  info_.size = sizeof(hdev_info);
  if (api_->get_info(handle_, &info_) != HDEV_OK) refuse_open(api_->last_error(handle_));
  if (const std::string wrong = objection(info_); !wrong.empty()) refuse_open(wrong);
  words_.shared = can(HDEV_CAP_SHARED);
  if (api_->calibrate(handle_, calibration_timeout_ms) != HDEV_OK)
    refuse_open(std::string("not calibrated: ") + api_->last_error(handle_));
}

Device::~Device() { close(); }

hdev_status Device::enable_force(bool on) noexcept {
  return handle_ == nullptr ? HDEV_E_LOST : api_->enable_force(handle_, on ? 1u : 0u);
}

void Device::stop() noexcept {
  if (handle_ != nullptr) api_->stop(handle_);
}

bool Device::motors_off() const noexcept {
  if (handle_ != nullptr) return api_->motors_off == nullptr || api_->motors_off(handle_) == HDEV_OK;
  return off_before_closing_ || !closing_ || closing_->wait_until(std::chrono::steady_clock::now());
}

bool Device::emergency_stop(std::uint32_t within_us) noexcept {
  if (handle_ == nullptr) return true;
  if (api_->emergency_stop != nullptr) return api_->emergency_stop(handle_, within_us) == HDEV_OK;
  const bool good = api_->stop(handle_) == HDEV_OK;
  nanosleep(&grace, nullptr);
  return good;
}

/// Before the handle is the closing thread's, and nobody may ask any more.
bool Device::becomes_off() const noexcept {
  if (api_->motors_off == nullptr) return true;
  const auto end = std::chrono::steady_clock::now() + off_within;
  while (!motors_off() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return motors_off();
}

/// What a driver says may have several lines, and come from anywhere.
std::string Device::last_words() const {
  const char* said = handle_ == nullptr ? nullptr : api_->last_error(handle_);
  std::string words = said == nullptr ? "" : said;
  constexpr std::size_t most = 300;
  if (words.size() > most) words.resize(most);
  for (char& c : words)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return words;
}

void Device::begin_close(bool answers) noexcept {
  if (handle_ == nullptr || closing_) return;
  off_before_closing_ = becomes_off();
  const bool forces = answers && can(HDEV_CAP_FORCE);
  closing_.emplace([api = api_, host = host_, handle = handle_, forces] {
    if (forces) {
      hdev_command nothing{};
      nothing.size = sizeof(hdev_command);
      api->write(handle, &nothing);
      api->enable_force(handle, 0);
    }
    api->close(handle);
  });
  close_by_ = std::chrono::steady_clock::now() + close_within;
  handle_ = nullptr;
}

bool Device::close() noexcept {
  begin_close(false);
  if (!closing_ || closing_->wait_until(close_by_)) return true;
  if (!told_) {
    const std::string line = fmt::format(
        "the driver \"{}\" does not come back from closing its device within {} ms; it is left behind{}",
        name_, close_within.count(), off_before_closing_ ? "" : std::string(": ") + motors_may_be_on);
    log_line(nullptr, 2, line.c_str());
  }
  told_ = true;
  return false;
}

}  // namespace palpate::haptic
