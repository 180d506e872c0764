#include "deploy/import/byte_stream.h"

#include <archive.h>
#include <archive_entry.h>

#include "common/error/error.h"

namespace palpate {

ByteStream::ByteStream(const std::string& path, Kind kind) : path_(path), archive_(archive_read_new()) {
  archive_read_support_filter_gzip(archive_);
  if (kind == Kind::tar) {
    archive_read_support_format_tar(archive_);
  } else {
    archive_read_support_format_raw(archive_);
  }
  try {
    if (archive_read_open_filename(archive_, path.c_str(), 1 << 16) != ARCHIVE_OK)
      complain("name a file that can be read");
    if (kind == Kind::plain && !next()) complain("name a file with something in it");
  } catch (...) {
    archive_read_free(archive_);
    throw;
  }
}

ByteStream::~ByteStream() { archive_read_free(archive_); }

std::optional<ByteStream::Entry> ByteStream::next() {
  archive_entry* entry = nullptr;
  const int status = archive_read_next_header(archive_, &entry);
  if (status == ARCHIVE_EOF) return std::nullopt;
  if (status != ARCHIVE_OK && status != ARCHIVE_WARN) complain("fetch a whole copy");
  const char* name = archive_entry_pathname(entry);
  Entry found;
  found.name = name == nullptr ? "" : name;
  found.name.erase(0, found.name.find_last_of('/') + 1);
  found.bytes = archive_entry_size_is_set(entry) != 0 ? archive_entry_size(entry) : -1;
  return found;
}

std::size_t ByteStream::read(unsigned char* to, std::size_t n) {
  std::size_t done = 0;
  while (done < n) {
    const la_ssize_t got = archive_read_data(archive_, to + done, n - done);
    if (got < 0) complain("fetch a whole copy");
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

void ByteStream::complain(const std::string& right) const {
  const char* reason = archive_error_string(archive_);
  throw InputError(path_ + ": damaged, truncated or of another format (" +
                   (reason == nullptr ? "unknown reason" : reason) + "); " + right);
}

}  // namespace palpate
