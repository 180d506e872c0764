#pragma once
// The text header of INRIMAGE-4 files: a multiple of 256 bytes, "#INRIMAGE-4#{", lines KEY=value, "##}".

#include <Eigen/Core>
#include <cstddef>
#include <string>

#include "deploy/import/byte_stream.h"
#include "deploy/import/read_cells.h"

namespace palpate {

struct InrHeader {
  CellLayout layout;
  Eigen::Vector3d spacing;  // [m]
  std::size_t bytes = 0;    // of the header itself
};

/// Does the file begin as an INRIMAGE-4 file does? @throws InputError: cannot be opened or gunzipped
bool has_inr_header(const std::string& path);

/// Reads the header and leaves the stream at the first cell. @throws InputError: no header, or one that makes no sense
InrHeader read_inr_header(ByteStream& stream, const std::string& where);

}  // namespace palpate
