// Throws datagrams at the UDP ports of a DDS domain on this machine's loopback interface: half of them random, half real
// ones that it overheard, with some bytes changed, cut or doubled.
// Command line: DOMAIN COUNT SEED. Says how many it overheard and sent; exit code 1 if it overheard nothing.

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <thread>
#include <vector>

#include "common/wire/loopback_config.h"
#include "deploy/lab/packet_port.h"

namespace {

using namespace palpate;
using Bytes = std::vector<std::uint8_t>;
using Clock = std::chrono::steady_clock;
constexpr std::size_t note = 10;   // bytes of the kernel in front of a frame
constexpr std::size_t heads = 42;  // Ethernet, IPv4 without options, UDP
constexpr std::size_t most_kept = 4000;
constexpr int participants = 6;

/// What DDS sends to the domain's ports within the time.
std::vector<Bytes> overhear(int domain, std::chrono::milliseconds time) {
  lab::PacketPort port("lo");
  std::vector<Bytes> heard;
  Bytes frame;
  pollfd polled{port.descriptor(), POLLIN, 0};
  for (const auto end = Clock::now() + time; Clock::now() < end && heard.size() < most_kept;) {
    poll(&polled, 1, 10);
    while (port.read(frame)) {
      if (frame.size() <= note + heads || frame[note + 23] != IPPROTO_UDP) continue;
      const int to = 256 * frame[note + 36] + frame[note + 37];
      if (to < discovery_port(domain, 0) || to > discovery_port(domain, max_participants) + 1) continue;
      heard.emplace_back(frame.begin() + note + heads, frame.end());
    }
  }
  return heard;
}

Bytes random_bytes(std::mt19937_64& random) {
  Bytes bytes(random() % 1500);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
  const char magic[] = {'R', 'T', 'P', 'S', 2, 1};
  if (random() % 2 == 0 && bytes.size() > sizeof magic) std::memcpy(bytes.data(), magic, sizeof magic);
  return bytes;
}

Bytes mutated(Bytes bytes, std::mt19937_64& random) {
  const std::size_t changes = 1 + random() % 8;
  for (std::size_t i = 0; i < changes; ++i)
    bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
  if (random() % 8 == 0) bytes.resize(1 + random() % bytes.size());
  if (random() % 16 == 0)
    bytes.insert(bytes.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(bytes.size() / 2));
  if (bytes.size() > 60'000) bytes.resize(60'000);
  return bytes;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const int domain = std::atoi(argv[1]);
  const long count = std::atol(argv[2]);
  std::mt19937_64 random(std::strtoull(argv[3], nullptr, 10));
  const auto real = overhear(domain, std::chrono::milliseconds(1000));
  if (real.empty()) return 1;
  const int descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  long sent = 0;
  for (long i = 0; i < count; ++i) {
    const Bytes bytes = i % 2 == 0 ? random_bytes(random) : mutated(real[random() % real.size()], random);
    sockaddr_in to = {};
    to.sin_family = AF_INET;
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    to.sin_port = htons(static_cast<std::uint16_t>(discovery_port(domain, 0) +
                                                   static_cast<int>(random() % (2 * participants))));
    sockaddr generic = {};
    std::memcpy(&generic, &to, sizeof to);
    if (sendto(descriptor, bytes.data(), bytes.size(), 0, &generic, sizeof generic) >= 0) ++sent;
    if (i % 8 == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));  // not a flood: each is to be read
  }
  close(descriptor);
  std::printf("overheard %zu sent %ld\n", real.size(), sent);
  return 0;
}
