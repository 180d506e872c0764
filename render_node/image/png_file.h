#pragma once
// Pictures as PNG files.

#include <string>

#include "render_node/image/image.h"
#include "render_node/image/packed_rows.h"

namespace palpate::render {

/// One that writes many keeps its memory.
class PngWriter {
 public:
  /// Writes beside, then renames: `path` is either complete or untouched. It bears the mark that
  /// is_own_picture() knows.
  /// @throws InputError if the file cannot be written
  void write(const Image& image, const std::string& path);

 private:
  RowPacker packer_;
};

/// The same, once.
void write_png(const Image& image, const std::string& path);

}  // namespace palpate::render
