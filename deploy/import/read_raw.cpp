#include "deploy/import/read_raw.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/error/error.h"
#include "common/math/units.h"
#include "common/record/volume_check.h"
#include "deploy/import/inr_header.h"
#include "deploy/import/read_cells.h"

namespace palpate {
namespace {

constexpr double spacing_agrees = 0.01;  // a person rounds

void skip(ByteStream& stream, const std::string& path, std::uint64_t bytes) {
  std::vector<unsigned char> waste(1 << 16);
  for (std::uint64_t left = bytes; left > 0;) {
    const std::size_t n = std::min<std::uint64_t>(left, waste.size());
    if (stream.read(waste.data(), n) < n)
      throw InputError(
          fmt::format("{}: ends within the header of {} bytes; give the right --header", path, bytes));
    left -= n;
  }
}

void check_agrees(const std::string& path, const InrHeader& header, const RawOptions& options) {
  const auto& [nx, ny, nz] = header.layout.size;
  if (options.size && *options.size != std::array<std::int64_t, 3>{nx, ny, nz})
    throw InputError(fmt::format("{}: --size {},{},{} is not what its header says; {},{},{} would be right",
                                 path, (*options.size)[0], (*options.size)[1], (*options.size)[2], nx, ny,
                                 nz));
  if (options.spacing &&
      !((*options.spacing - header.spacing).array().abs() <= spacing_agrees * header.spacing.array()).all())
    throw InputError(fmt::format(
        "{}: --spacing-mm is not what its header says; {:g},{:g},{:g} would be right", path,
        mm_from_m(header.spacing[0]), mm_from_m(header.spacing[1]), mm_from_m(header.spacing[2])));
  if (options.type && *options.type != header.layout.type)
    throw InputError(fmt::format("{}: --type is not what its header says; {} would be right", path,
                                 name_of(header.layout.type)));
  if (options.header_bytes && *options.header_bytes != header.bytes)
    throw InputError(fmt::format("{}: --header is not what it has; {} would be right", path, header.bytes));
}

}  // namespace

Volume read_raw(const std::string& path, const RawOptions& options) {
  if (!options.size || !options.spacing || !options.type)
    throw InputError(
        path + ": bare cells do not tell their shape; give --size nx,ny,nz --spacing-mm x,y,z --type T");
  Volume volume;
  volume.size = check_size(path, *options.size);
  check_spacing(path, *options.spacing);
  volume.spacing = *options.spacing;
  ByteStream stream(path, ByteStream::Kind::plain);
  skip(stream, path, options.header_bytes.value_or(0));
  volume.intensity = read_cells(stream, path, {volume.size, *options.type, false});
  return volume;
}

Volume read_inr(const std::string& path, const RawOptions& options) {
  if (!has_inr_header(path)) return read_raw(path, options);
  ByteStream stream(path, ByteStream::Kind::plain);
  const InrHeader header = read_inr_header(stream, path);
  check_agrees(path, header, options);
  Volume volume;
  volume.size = header.layout.size;
  volume.spacing = header.spacing;
  volume.intensity = read_cells(stream, path, header.layout);
  return volume;
}

}  // namespace palpate
