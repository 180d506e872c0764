#pragma once
// What the watched driver (watched_driver.cpp) shares with a test, in a file that both map: the test asks for trouble,
// the driver writes down every call. The file outlives the process of the driver, however that ends.

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>

namespace palpate::test {

struct WatchedDevice {
  static constexpr const char* variable = "PALPATE_WATCHED_DEVICE";  // of the environment: the file
  static constexpr std::size_t kept = 1u << 16;                      // writes, the newest ones

  struct Write {
    std::int64_t t_ns = 0;  // by the host's clock
    double z = 0;           // of the sample before [m]
    double felt =
        0;  // force along z that the hand felt at that sample, the device's own watchdog included [N]
    double force = 0;   // written, along z [N]
    double norm = 0;    // of the force written [N]
    double torque = 0;  // norm of the torque written [N m]
    std::uint32_t powered = 0;
  };

  // what the test asks for
  std::atomic<std::uint32_t> unplugged{0}, estop{0}, let_go{0};
  std::atomic<std::uint32_t> crash{0};  // 1: a thread of the driver reads from nowhere; 2: it calls exit(3)
  std::atomic<std::uint32_t> block_read_ms{0};  // each read takes so long
  std::atomic<std::uint32_t> hang_open{0}, hang_read{0}, hang_enable{0},
      hang_close{0};                       // the call does not come back while this is set
  std::atomic<std::uint32_t> dropped{0};   // it has switched its motors off by itself, without a fault
  std::atomic<std::uint32_t> dead{0};      // HDEV_FAULT_SILENT
  std::atomic<std::uint32_t> nonsense{0};  // positions are not numbers
  std::atomic<double> temperature{-1};     // of its motors
  std::array<char, 96> words{};            // last_error() of the open device
  // what was called
  std::atomic<std::uint64_t> opening{0}, opened{0}, closed{0}, calibrated{0}, enabled{0}, disabled{0},
      stops{0}, reads{0}, writes{0};
  std::atomic<std::uint64_t> after_lost{
      0};                                 // calls but close() after read() has said that the device is lost
  std::atomic<std::uint32_t> powered{0};  // now
  std::atomic<int> loop_thread{0};        // that has called rt_attach()
  std::array<Write, kept> log{};          // write number n, from 0, at n % kept

  const Write& at(std::uint64_t n) const { return log[n % kept]; }
};

/// The file, mapped. The test makes it and puts its name into the environment; the driver opens it.
class WatchedFile {
 public:
  enum class Role { test, driver };
  WatchedFile(const std::string& path, Role role) : path_(path), role_(role) {
    const int file =
        open(path.c_str(), O_RDWR | O_CLOEXEC | (role == Role::test ? O_CREAT | O_TRUNC : 0), 0600);
    if (file < 0 || (role == Role::test && ftruncate(file, sizeof(WatchedDevice)) != 0))
      throw std::runtime_error(path + ": cannot be shared");
    void* memory =
        mmap(nullptr, sizeof(WatchedDevice), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, file, 0);
    close(file);
    if (memory == MAP_FAILED) throw std::runtime_error(path + ": cannot be mapped");
    device_ = role == Role::test ? new (memory) WatchedDevice : static_cast<WatchedDevice*>(memory);
    if (role == Role::test) setenv(WatchedDevice::variable, path.c_str(), 1);
  }
  ~WatchedFile() {
    munmap(device_, sizeof(WatchedDevice));
    if (role_ == Role::test) std::filesystem::remove(path_);
  }
  WatchedFile(const WatchedFile&) = delete;
  WatchedFile& operator=(const WatchedFile&) = delete;

  WatchedDevice* operator->() const { return device_; }
  WatchedDevice& operator*() const { return *device_; }

 private:
  std::string path_;
  Role role_;
  WatchedDevice* device_ = nullptr;
};

}  // namespace palpate::test
