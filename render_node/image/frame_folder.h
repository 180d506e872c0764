#pragma once
// OUT/frames/frame_00001.png and so on, within the budget that the scene gives them. A disk that takes no
// more costs pictures, never the session. Pictures are written beside: who draws waits only if the one before is not
// done.

#include <cstdint>
#include <filesystem>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "common/scene/scene_fwd.h"
#include "render_node/image/image.h"
#include "render_node/image/own_picture.h"
#include "render_node/image/png_file.h"

namespace palpate::render {

class FrameFolder {
 public:
  /// Makes the folder. Numbers go on after the pictures that lie there: a node that is started again writes
  /// over none, and its own of before count towards the budget.
  /// @param spec  most_frames, most_frame_bytes
  /// @throws InputError if it cannot be made, or is a link
  FrameFolder(const std::filesystem::path& out, const RenderSpec& spec);
  FrameFolder(FrameFolder&&) = default;
  FrameFolder& operator=(FrameFolder&&) = default;
  ~FrameFolder();

  /// Is the picture that is due now to be kept? Ask once for each; one that is not need not be drawn. Where
  /// the budget is reached, every second picture that lies there goes, those left are numbered anew, and half
  /// as many are kept from here on: what is left is always spread evenly over the whole session.
  bool wants_next();

  /// Begins to write the picture that was wanted. The first that cannot be written is logged, and from then on all are
  /// only counted.
  void keep(const Image& image);
  /// Waits until all that was kept lies there, or is lost. What follows knows no more than was settled.
  void settle();

  std::uint64_t lost() const noexcept { return lost_; }
  const std::string& why() const noexcept { return why_; }  // of the first lost one; empty: none is

  std::size_t kept() const noexcept { return kept_.size(); }     // that lie there
  std::uint64_t left_out() const noexcept { return left_out_; }  // that were due and do not lie there
  std::uint64_t every() const noexcept { return every_; }        // how many are due for each that is kept

 private:
  bool is_full() const;
  void thin();
  struct Written {
    std::uint64_t bytes = 0;
    std::string why;  // it is lost; empty: it is there
  };
  /// What is being written, and what writes it.
  struct Work {
    Image image;
    PngWriter writer;
  };
  static Written write(Work* work, const std::filesystem::path& path);

  std::filesystem::path folder_;
  std::size_t most_;
  double most_bytes_;
  std::vector<OwnPicture> kept_;  // in order
  int last_ = 0;                  // highest number there, anybody's
  std::uint64_t offered_ = 0, every_ = 1, left_out_ = 0, lost_ = 0;
  std::string why_;
  std::future<Written> pending_;  // before what it works on: one that is replaced is waited for
  std::unique_ptr<Work> work_ = std::make_unique<Work>();
};

}  // namespace palpate::render
