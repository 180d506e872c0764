#include "deploy/import/inflated_length.h"

#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <vector>

namespace palpate {

std::optional<std::uint64_t> inflated_length(const std::string& file, std::uint64_t offset,
                                             std::uint64_t bytes) {
  std::ifstream from(file, std::ios::binary);
  from.seekg(static_cast<std::streamoff>(offset));
  std::vector<unsigned char> in(1 << 16), waste(1 << 18);
  z_stream stream{};
  if (inflateInit2(&stream, 15 + 32) != Z_OK) return std::nullopt;  // zlib or gzip, by its header
  int status = Z_OK;
  while (status == Z_OK) {
    if (stream.avail_in == 0) {
      from.read(reinterpret_cast<char*>(in.data()),
                static_cast<std::streamsize>(std::min<std::uint64_t>(bytes, in.size())));
      stream.next_in = in.data();
      stream.avail_in = static_cast<unsigned>(from.gcount());
      bytes -= stream.avail_in;
    }
    stream.next_out = waste.data();
    stream.avail_out = static_cast<unsigned>(waste.size());
    status = inflate(&stream, Z_NO_FLUSH);  // Z_BUF_ERROR once nothing comes in any more
  }
  const std::uint64_t length = stream.total_out;
  inflateEnd(&stream);
  return status == Z_STREAM_END ? std::optional(length) : std::nullopt;
}

}  // namespace palpate
