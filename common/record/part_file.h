#pragma once
// Writing beside, then renaming: a reader sees the old file or the whole new one, never half of it.

#include <string>

namespace palpate {

/// The place beside `path` where its next contents are written. Unless committed, it is removed at the end.
class PartFile {
 public:
  /// Makes the empty `path`.part. @throws InputError: no such folder, may not be written, `path` is a folder
  explicit PartFile(std::string path);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;

  const std::string& part() const noexcept { return part_; }

  /// Renames over `path`. @throws InputError if that is not possible
  void commit();

 private:
  std::string path_;
  std::string part_;
  bool committed_ = false;
};

/// Removes what a killed process left beside `path`.
void remove_part(const std::string& path) noexcept;

/// What PartFile would complain about, before the work is done. Leaves nothing.
void check_can_write(const std::string& path);

}  // namespace palpate
