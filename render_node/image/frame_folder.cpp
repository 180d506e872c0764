#include "render_node/image/frame_folder.h"

#include <algorithm>
#include <chrono>
#include <numeric>

#include "common/error/error.h"
#include "common/report/log.h"
#include "common/scene/render_spec.h"

namespace palpate::render {
namespace fs = std::filesystem;

FrameFolder::FrameFolder(const fs::path& out, const RenderSpec& spec)
    : folder_(out / "frames"),
      most_(static_cast<std::size_t>(spec.most_frames)),
      most_bytes_(spec.most_frame_bytes) {
  if (out.empty()) throw InputError("nowhere to put frames; give --out DIR, or a display for a window");
  std::error_code error;
  if (fs::is_symlink(folder_, error))
    throw InputError(folder_.string() + ": is a link; remove it, or choose another --out");
  fs::create_directories(folder_, error);
  if (error)
    throw InputError(folder_.string() + ": cannot be made (" + error.message() + "); choose another --out");
  for (const auto& entry : fs::directory_iterator(folder_, error))
    last_ = std::max(last_, frame_number(entry.path().filename().string()).value_or(0));
  kept_ = own_pictures(folder_);
}

FrameFolder::~FrameFolder() { settle(); }

bool FrameFolder::is_full() const {
  const auto bytes = [](double sum, const OwnPicture& picture) {
    return sum + static_cast<double>(picture.bytes);
  };
  // One that is being written weighs about as much as that before it.
  const bool more = pending_.valid();
  const double likely = more && !kept_.empty() ? static_cast<double>(kept_.back().bytes) : 0;
  return kept_.size() + (more ? 1 : 0) >= most_ ||
         std::accumulate(kept_.begin(), kept_.end(), likely, bytes) >= most_bytes_;
}

bool FrameFolder::wants_next() {
  if (pending_.valid() && pending_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) settle();
  const std::uint64_t n = offered_++;
  if (n % every_ == 0 && is_full()) {
    settle();
    if (is_full()) thin();
  }
  const bool wanted = n % every_ == 0;
  left_out_ += wanted ? 0 : 1;
  return wanted;
}

void FrameFolder::thin() {
  if (every_ == 1)
    log_warn(
        "frames: {} pictures of {:.0f} MB may lie there (most_frames, most_frames_MB of [render]); every "
        "second one goes, and "
        "half as many come from here on",
        most_, 1e-6 * most_bytes_);
  every_ *= 2;
  std::vector<OwnPicture> left;
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    std::error_code error;
    const fs::path picture = folder_ / frame_name(kept_[i].number);
    if (i % 2 != 0) {
      fs::remove(picture, error);
      ++left_out_;
      continue;
    }
    // The place is one that has just become free, of a picture of ours.
    const int number = kept_[left.size()].number;
    if (number != kept_[i].number) fs::rename(picture, folder_ / frame_name(number), error);
    left.push_back({error ? kept_[i].number : number, kept_[i].bytes});
  }
  if (!kept_.empty() && last_ == kept_.back().number) last_ = left.back().number;
  kept_ = std::move(left);
}

FrameFolder::Written FrameFolder::write(Work* work, const fs::path& path) {
  try {
    work->writer.write(work->image, path);
  } catch (const InputError& error) {
    return {0, error.what()};
  }
  std::error_code unknown;
  const auto bytes = fs::file_size(path, unknown);
  return {unknown ? 0 : bytes, {}};
}

void FrameFolder::keep(const Image& image) {
  settle();
  if (lost_ > 0) {  // what room there is again is for what tells of it
    ++lost_;
    return;
  }
  work_->image = image;
  pending_ = std::async(std::launch::async, write, work_.get(), folder_ / frame_name(last_ + 1));
}

void FrameFolder::settle() {
  if (!pending_.valid()) return;
  const Written written = pending_.get();
  if (written.why.empty()) {
    kept_.push_back({++last_, written.bytes});
    return;
  }
  ++lost_;
  why_ = written.why;
  log_error("{}; the session goes on without pictures", why_);
}

}  // namespace palpate::render
