#pragma once
// The cable between a stranger's library and its hardware, in a file that both sides map and that outlives every process.
// The hardware is as patient as hardware can be: without a watchdog, it goes on with the last force that it was told, as
// long as its motors are on. Stand-ins that were written from the vendors' documents use it, and tests, which look at what
// the hardware does, and ask for trouble.

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string>

namespace palpate::test {

inline std::int64_t bus_time_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

struct StrangerBus {
  static constexpr const char* variable = "STRANGER_BUS";  // of the environment: the file
  static constexpr std::size_t kept = 1u << 16;

  enum What : std::uint32_t { force_told, motors_on, motors_off, opened, closed };
  struct Packet {
    std::int64_t t_ns;
    What what;
    double newton;  // norm of the force that the hand feels after it
    int pid;
  };
  enum Trouble : std::uint32_t {
    none,
    own_thread,       // a thread of the library reads from nowhere
    own_stack,        // and this one runs over its stack
    own_abort,        // and this one calls abort()
    own_arithmetic,   // SIGFPE
    own_instruction,  // SIGILL
    own_bus,          // SIGBUS: a page of a file that has become shorter
    servo_in_frame,   // the servo thread, within a call of the host's callback
    servo_outside,    // the servo thread, between two rounds
    own_exit,         // exit(3) in a thread of the library
    switch_crashes,  // the servo thread stands still, and the call that switches motors off reads from nowhere
    switch_hangs,  // hdDisable, dhdEnableForce never return in the process that has the device, and its servo thread
                   // stands still; other threads live
    begin_hangs,           // the servo thread does not come back from beginning a frame
    end_hangs,             // whoever ends a frame, or sets a force of libdhd, does not come back
    end_and_disable_hang,  // nor from hdDisable, dhdEnableForce
    all_hang,              // nor from hdDisableDevice, dhdStop
  };

  // what the test asks for
  std::atomic<std::uint32_t> trouble{none};
  std::atomic<double> depth_mm{0};  // how far the hand goes down once the motors are on
  // the hardware
  std::atomic<int> owner{0};  // process that has it open
  std::atomic<bool> motors{false};
  std::atomic<double> force{0};  // told last [N]
  // what came over the cable, in order, the newest ones
  std::atomic<std::uint64_t> n_packets{0};
  std::array<Packet, kept> packets{};
  // breaches of the rules of use
  std::atomic<std::uint32_t> n_breaches{0};
  std::array<std::array<char, 96>, 16> breaches{};
  std::atomic<int> last_owner{
      0};  // that opened it last; at the end: a service in Python reads what is before

  /// Where the hand is, so long after the motors are on: down in 0.8 s, up after 4 s and down again after 5, in case that
  /// nobody was there to feel it the first time.
  double depth_after(double t_s) const {
    const double t = t_s - 5 * static_cast<double>(static_cast<int>(t_s / 5));
    return depth_mm.load() * (t < 4 ? std::fmin(t / 0.8, 1) : std::fmax(1 - (t - 4) / 0.4, 0));
  }
  double felt() const { return motors.load() ? force.load() : 0.0; }
  void send(What what) {
    const std::uint64_t n = n_packets.load();
    packets[n % kept] = {bus_time_ns(), what, felt(), getpid()};
    n_packets.store(n + 1);
  }
  void breach(const char* words) {
    const std::uint32_t n = n_breaches.fetch_add(1);
    if (n < breaches.size()) std::snprintf(breaches[n].data(), breaches[n].size(), "%s", words);
  }
  /// False while another process that lives has it. Who takes it from another one, dead or not, is spared its trouble.
  bool take_hold() {
    const int holder = owner.load();
    if (holder != 0 && holder != getpid() && kill(holder, 0) == 0) return false;
    if (const int before = last_owner.exchange(getpid()); before != 0 && before != getpid())
      trouble.store(none);
    owner.store(getpid());
    send(opened);
    return true;
  }
};

/// Maps the file that the test has made.
inline StrangerBus& stranger_bus() {
  static StrangerBus* const bus = [] {
    const char* path = std::getenv(StrangerBus::variable);
    const int file = path == nullptr ? -1 : open(path, O_RDWR | O_CLOEXEC);
    void* memory = file < 0 ? MAP_FAILED
                            : mmap(nullptr, sizeof(StrangerBus), PROT_READ | PROT_WRITE,
                                   MAP_SHARED | MAP_POPULATE, file, 0);
    if (memory == MAP_FAILED) std::abort();
    close(file);
    return static_cast<StrangerBus*>(memory);
  }();
  return *bus;
}

/// The test's end: makes the file and names it in the environment.
class StrangerBusFile {
 public:
  explicit StrangerBusFile(std::string path) : path_(std::move(path)) {
    const int file = open(path_.c_str(), O_RDWR | O_CLOEXEC | O_CREAT | O_TRUNC, 0600);
    if (file < 0 || ftruncate(file, sizeof(StrangerBus)) != 0) throw std::runtime_error(path_);
    void* memory =
        mmap(nullptr, sizeof(StrangerBus), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, file, 0);
    close(file);
    if (memory == MAP_FAILED) throw std::runtime_error(path_);
    bus_ = new (memory) StrangerBus;
    setenv(StrangerBus::variable, path_.c_str(), 1);
  }
  ~StrangerBusFile() {
    munmap(bus_, sizeof(StrangerBus));
    unlink(path_.c_str());
  }
  StrangerBusFile(const StrangerBusFile&) = delete;
  StrangerBusFile& operator=(const StrangerBusFile&) = delete;
  StrangerBus* operator->() const { return bus_; }
  StrangerBus& operator*() const { return *bus_; }

 private:
  std::string path_;
  StrangerBus* bus_;
};

}  // namespace palpate::test
