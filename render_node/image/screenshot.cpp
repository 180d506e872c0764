#include "render_node/image/screenshot.h"

#include <fmt/format.h>

#include <filesystem>

#include "common/error/error.h"
#include "render_node/image/png_file.h"

namespace palpate::render {

std::string save_screenshot(const Image& image, const std::string& folder) {
  constexpr int most = 9999;  // Why: four digits sort by name, and nobody presses a key more often
  for (int n = 1; n <= most; ++n) {
    const auto path = std::filesystem::path(folder) / fmt::format("picture_{:04}.png", n);
    std::error_code unseen;
    if (std::filesystem::symlink_status(path, unseen).type() != std::filesystem::file_type::not_found)
      continue;
    write_png(image, path.string());
    return path.string();
  }
  throw InputError(folder + ": no number below 10000 is free for a picture; move some away");
}

}  // namespace palpate::render
