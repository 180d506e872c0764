#include "haptic_node/loop/flight_recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include "common/error/error.h"
#include "common/file/new_file.h"

namespace palpate::haptic {

FlightRecorder::FlightRecorder(double rate_Hz)
    : after_ticks_(std::max<std::uint64_t>(1, static_cast<std::uint64_t>(after_s * rate_Hz))) {
  for (Ring& ring : rings_) ring.samples.resize(static_cast<std::size_t>(std::ceil(kept_s * rate_Hz)));
}

void FlightRecorder::add(const FlightSample& sample) noexcept {
  Ring& ring = rings_[static_cast<std::size_t>(running_)];
  ring.samples[ring.n % ring.samples.size()] = sample;
  ring.n += 1;
  if (left_ > 0 && --left_ == 0) keep();
}

void FlightRecorder::trigger() noexcept {
  if (left_ == 0) left_ = after_ticks_;
}

void FlightRecorder::keep() noexcept {
  if (kept_.load(std::memory_order_acquire) >= 0) {
    dropped_.fetch_add(1);
    return;
  }
  const int full = running_;
  running_ = 1 - running_;
  rings_[static_cast<std::size_t>(running_)].n = 0;
  kept_.store(full, std::memory_order_release);
}

void FlightRecorder::end() noexcept {
  if (left_ > 0) keep();
  left_ = 0;
}

bool FlightRecorder::write_kept(const std::string& path) {
  const int kept = kept_.load(std::memory_order_acquire);
  if (kept < 0) return false;
  const Ring& ring = rings_[static_cast<std::size_t>(kept)];
  const auto refuse = [&] {
    throw InputError(fmt::format("{}: cannot be written ({})", path, std::strerror(errno)));
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(open_new(path), &std::fclose);
  if (file == nullptr) {
    const int error = errno;
    kept_.store(-1, std::memory_order_release);
    errno = error;
    refuse();
  }
  fmt::print(
      file.get(),
      "t_s,state,x_m,y_m,z_m,qw,qx,qy,qz,proxy_x_m,proxy_y_m,proxy_z_m,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,"
      "energy_J,surplus_J,patch_age_s\n");
  const auto put = [&file](const auto& values) {
    for (const double value : values) fmt::print(file.get(), ",{:.9g}", value);
  };
  const std::uint64_t size = ring.samples.size();
  for (std::uint64_t i = ring.n - std::min(ring.n, size); i < ring.n; ++i) {
    const FlightSample& s = ring.samples[i % size];
    fmt::print(file.get(), "{:.6f},{}", s.trace.t, name_of(s.state));
    put(s.trace.p), put(s.q_WT), put(s.trace.proxy), put(s.trace.force), put(s.trace.torque);
    fmt::print(file.get(), ",{:.6g},{:.6g},{:.6f}\n", s.trace.energy, s.surplus, s.patch_age);
  }
  const bool whole = std::fflush(file.get()) == 0 && std::ferror(file.get()) == 0;
  kept_.store(-1, std::memory_order_release);
  if (!whole) refuse();
  return true;
}

}  // namespace palpate::haptic
