#include "render_node/image/frame_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "common/error/error.h"
#include "common/report/log.h"

namespace palpate::render {
namespace fs = std::filesystem;

FrameFolder::FrameFolder(const std::string& out) {
  if (out.empty()) throw InputError("nowhere to put frames; give --out DIR, or a display for a window");
  folder_ = fs::path(out) / "frames";
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error)
    throw InputError(folder_.string() + ": cannot be made (" + error.message() + "); choose another --out");
  for (const auto& entry : fs::directory_iterator(folder_, error)) {
    int number = 0;
    if (std::sscanf(entry.path().filename().c_str(), "frame_%d.png", &number) == 1)
      last_ = std::max(last_, number);
  }
}

void FrameFolder::keep(const Image& image) {
  if (lost_ > 0) {  // what room there is again is for what tells of it
    ++lost_;
    return;
  }
  try {
    write_png(image, folder_ / fmt::format("frame_{:05}.png", last_ + 1));
    ++last_;
  } catch (const InputError& error) {
    ++lost_;
    why_ = error.what();
    log_error("{}; the session goes on without pictures", why_);
  }
}

}  // namespace palpate::render
