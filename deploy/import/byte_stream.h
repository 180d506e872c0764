#pragma once
// The one door to libarchive: the bytes of a file, gunzipped if need be, or of the entries of a tar archive.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

struct archive;

namespace palpate {

class ByteStream {
 public:
  enum class Kind { plain, tar };
  struct Entry {
    std::string name;        // without its folder; of a plain file: empty
    std::int64_t bytes = 0;  // as the archive says; of a plain file: -1
  };

  /// Opens the file. A plain file is one entry, already begun.
  /// @throws InputError: cannot be opened, is not a tar archive
  ByteStream(const std::string& path, Kind kind);
  ~ByteStream();
  ByteStream(const ByteStream&) = delete;
  ByteStream& operator=(const ByteStream&) = delete;

  /// The next entry, or nothing at the end. @throws InputError: damaged or truncated
  std::optional<Entry> next();

  /// Up to `n` bytes of the current entry; fewer only at its end. @throws InputError: damaged or truncated
  std::size_t read(unsigned char* to, std::size_t n);

 private:
  [[noreturn]] void complain(const std::string& right) const;

  std::string path_;
  archive* archive_;
};

}  // namespace palpate
