#pragma once
// Room on the disk kept for the end of a session: whatever fills the disk meanwhile, the summaries can still be written.

#include <filesystem>

namespace palpate::deploy {

class DiskReserve {
 public:
  static constexpr long bytes = 1 << 20;

  /// Takes the room, as FOLDER/parts/reserve. @throws InputError: the disk has no such room
  explicit DiskReserve(const std::filesystem::path& folder);
  ~DiskReserve() { release(); }  // the room is for whoever writes next
  DiskReserve(const DiskReserve&) = delete;
  DiskReserve& operator=(const DiskReserve&) = delete;

 private:
  void release() noexcept;

  std::filesystem::path file_;
};

}  // namespace palpate::deploy
