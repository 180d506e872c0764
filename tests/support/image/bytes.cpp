#include "tests/support/image/bytes.h"

#include <archive.h>
#include <archive_entry.h>

#include <memory>
#include <stdexcept>
#include <string_view>

namespace palpate::test {
namespace {

la_ssize_t append(archive*, void* to, const void* data, std::size_t n) {
  static_cast<Bytes*>(to)->append(static_cast<const char*>(data), n);
  return static_cast<la_ssize_t>(n);
}

Bytes written(const NamedBytes& entries, bool tar) {
  Bytes result;
  const std::unique_ptr<archive, int (*)(archive*)> out(archive_write_new(), archive_write_free);
  if (tar) {
    archive_write_set_format_ustar(out.get());
  } else {
    archive_write_add_filter_gzip(out.get());
    archive_write_set_format_raw(out.get());
  }
  archive_write_set_bytes_in_last_block(out.get(),
                                        1);  // no padding, so that cutting the end cuts the contents
  archive_write_open(out.get(), &result, nullptr, append, nullptr);
  for (const auto& [name, bytes] : entries) {
    const std::unique_ptr<archive_entry, void (*)(archive_entry*)> entry(archive_entry_new(),
                                                                         archive_entry_free);
    archive_entry_set_pathname(entry.get(), name.c_str());
    archive_entry_set_size(entry.get(), static_cast<la_int64_t>(bytes.size()));
    archive_entry_set_filetype(entry.get(), AE_IFREG);
    archive_entry_set_perm(entry.get(), 0644);
    archive_write_header(out.get(), entry.get());
    archive_write_data(out.get(), bytes.data(), bytes.size());
  }
  archive_write_close(out.get());
  return result;
}

}  // namespace

Bytes gzipped(const Bytes& bytes) { return written({{"data", bytes}}, false); }

Bytes tarred(const NamedBytes& entries) { return written(entries, true); }

Bytes entry_of_tar_gz(const std::string& path, const std::string& name) {
  const std::unique_ptr<archive, int (*)(archive*)> in(archive_read_new(), archive_read_free);
  archive_read_support_filter_gzip(in.get());
  archive_read_support_format_tar(in.get());
  if (archive_read_open_filename(in.get(), path.c_str(), 1 << 16) != ARCHIVE_OK)
    throw std::runtime_error("cannot open " + path);
  archive_entry* entry = nullptr;
  while (archive_read_next_header(in.get(), &entry) == ARCHIVE_OK) {
    if (!std::string_view(archive_entry_pathname(entry)).ends_with(name)) continue;
    Bytes bytes(static_cast<std::size_t>(archive_entry_size(entry)), '\0');
    archive_read_data(in.get(), bytes.data(), bytes.size());
    return bytes;
  }
  throw std::runtime_error(path + " has no " + name);
}

}  // namespace palpate::test
