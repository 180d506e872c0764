// palpate-link A B: joins two network interfaces by a cable that delays, loses and reorders. Ends with SIGTERM and says
// then how many frames it took and lost.

#include <poll.h>
#include <sys/prctl.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <ctime>

#include "common/error/error.h"
#include "common/process/checked_option.h"
#include "common/process/stop_flag.h"
#include "common/time/clock.h"
#include "deploy/lab/link_model.h"
#include "deploy/lab/packet_port.h"

namespace {

using namespace palpate;

/// Until a frame comes, the next is due, or a tenth of a second has gone.
void wait(std::array<pollfd, 2>& ports, const lab::LinkModel& link) {
  std::int64_t most_ns = 100'000'000;
  if (const auto due = link.next_due_ns()) most_ns = std::clamp<std::int64_t>(*due - now_ns(), 0, most_ns);
  const timespec time = {0, most_ns};
  ppoll(ports.data(), ports.size(), &time, nullptr);
}

void join(lab::PacketPort& a, lab::PacketPort& b, lab::LinkModel& link) {
  const std::array<lab::PacketPort*, 2> ports = {&a, &b};
  std::array<pollfd, 2> polled = {pollfd{a.descriptor(), POLLIN, 0}, pollfd{b.descriptor(), POLLIN, 0}};
  std::vector<std::uint8_t> frame;
  while (!stop_requested()) {
    wait(polled, link);
    for (int from = 0; from < 2; ++from)
      while (ports[static_cast<std::size_t>(from)]->read(frame)) link.take(now_ns(), 1 - from, frame);
    while (const auto due = link.give(now_ns())) ports[static_cast<std::size_t>(due->to)]->write(due->bytes);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::array<std::string, 2> interfaces;
  lab::LinkQuality quality;
  std::uint64_t seed = 1;
  CLI::App app{"palpate-link: a cable between two network interfaces that delays, loses and reorders"};
  app.add_option("a", interfaces[0], "network interface")->required();
  app.add_option("b", interfaces[1], "network interface")->required();
  app.add_option("--delay-ms", quality.delay_ms, "each way")->check(number_in({.lo = 0, .hi = 10'000}));
  app.add_option("--jitter-ms", quality.jitter_ms, "uniform, on top")
      ->check(number_in({.lo = 0, .hi = 10'000}));
  app.add_option("--loss-percent", quality.loss_percent, "of frames")->check(number_in({.lo = 0, .hi = 100}));
  app.add_option("--seed", seed, "of loss and jitter");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_ok : exit_mistake;
  }
  try {
    install_stop_handlers();
    prctl(PR_SET_TIMERSLACK, 1UL);
    lab::PacketPort a(interfaces[0]), b(interfaces[1]);
    lab::LinkModel link(quality, seed);
    join(a, b, link);
    std::printf("frames %llu lost %llu\n", static_cast<unsigned long long>(link.taken()),
                static_cast<unsigned long long>(link.lost()));
  } catch (const InputError& error) {
    std::fprintf(stderr, "palpate-link: %s\n", error.what());
    return exit_mistake;
  }
  return exit_ok;
}
