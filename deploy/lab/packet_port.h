#pragma once
// One network interface, frame by frame, past the machine's own network stack.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace palpate::lab {

class PacketPort {
 public:
  /// @throws InputError if there is no such interface, or no right to read it
  explicit PacketPort(const std::string& interface);
  ~PacketPort();
  PacketPort(const PacketPort&) = delete;
  PacketPort& operator=(const PacketPort&) = delete;

  int descriptor() const noexcept { return descriptor_; }
  /// The next frame that has come, with the kernel's note in front of it that says which sums are still to be made: a
  /// veth pair leaves them out. @return false if there is none
  bool read(std::vector<std::uint8_t>& frame);
  void write(std::span<const std::uint8_t> frame);

 private:
  int descriptor_ = -1;
};

}  // namespace palpate::lab
