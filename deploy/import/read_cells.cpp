#include "deploy/import/read_cells.h"

#include <fmt/format.h>

#include "common/error/error.h"
#include "deploy/import/memory_budget.h"

namespace palpate {

std::vector<float> read_cells(ByteStream& stream, const std::string& where, const CellLayout& layout) {
  const auto& [nx, ny, nz] = layout.size;
  const std::size_t slice = static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny);
  const std::size_t slice_bytes = slice * bytes_of(layout.type);
  const auto wanted = fmt::format("{} x {} x {} cells of {} are {} bytes", nx, ny, nz, name_of(layout.type),
                                  slice_bytes * static_cast<std::size_t>(nz));
  declare_cells(where, slice * static_cast<std::size_t>(nz),
                written_bytes + static_cast<double>(bytes_of(layout.type)) / nz);
  std::vector<float> cells;
  cells.reserve(slice * static_cast<std::size_t>(nz));
  std::vector<unsigned char> bytes(slice_bytes);
  for (int k = 0; k < nz; ++k) {
    const std::size_t got = stream.read(bytes.data(), slice_bytes);
    if (got < slice_bytes)
      throw InputError(fmt::format("{}: holds {} bytes of cells; {}", where,
                                   static_cast<std::size_t>(k) * slice_bytes + got, wanted));
    cells.resize(cells.size() + slice);
    decode(bytes.data(), slice, layout.type, layout.big_endian, cells.data() + cells.size() - slice);
  }
  if (stream.read(bytes.data(), 1) > 0)
    throw InputError(where + ": holds more bytes than its cells; " + wanted);
  return cells;
}

}  // namespace palpate
