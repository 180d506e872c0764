#pragma once
// OUT/frames/frame_00001.png and so on. A disk that takes no more costs pictures, never the session.

#include <cstdint>
#include <filesystem>
#include <string>

#include "render_node/image/image.h"

namespace palpate::render {

class FrameFolder {
 public:
  /// Makes the folder. Numbers go on after the pictures that lie there: a node that is started again writes over none.
  /// @throws InputError if it cannot be made
  explicit FrameFolder(const std::string& out);

  /// Writes the next picture. The first that cannot be written is logged, and from then on all are only counted.
  void keep(const Image& image);

  std::uint64_t lost() const noexcept { return lost_; }
  const std::string& why() const noexcept { return why_; }  // of the first lost one; empty: none is

 private:
  std::filesystem::path folder_;
  int last_ = 0;
  std::uint64_t lost_ = 0;
  std::string why_;
};

}  // namespace palpate::render
