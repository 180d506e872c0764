#include "render_node/image/own_picture.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <system_error>

namespace palpate::render {
namespace fs = std::filesystem;

namespace {

constexpr std::string_view before = "frame_", after = ".png";
// PNG (W3C): 8 bytes of signature, the chunk IHDR of 25 bytes; then ours, tEXt: length, type, keyword, 0,
// text.
constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";
constexpr std::string_view mark{"\0\0\0\x10tEXtSoftware\0palpate", 24};
constexpr std::size_t mark_at = 33;

}  // namespace

std::string frame_name(int number) { return fmt::format("{}{:05}{}", before, number, after); }

std::optional<int> frame_number(const std::string& name) {
  if (!name.starts_with(before) || !name.ends_with(after) || name.size() < before.size() + after.size())
    return std::nullopt;
  const std::string digits = name.substr(before.size(), name.size() - before.size() - after.size());
  int number = 0;
  const auto [end, trouble] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool whole = trouble == std::errc() && end == digits.data() + digits.size() && number > 0;
  return whole && frame_name(number) == name ? std::optional(number) : std::nullopt;
}

bool is_own_picture(const fs::path& path) noexcept {
  const int file = open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return false;
  std::array<char, mark_at + mark.size()> head{};
  const bool whole = read(file, head.data(), head.size()) == static_cast<ssize_t>(head.size());
  close(file);
  const std::string_view text(head.data(), head.size());
  return whole && text.starts_with(signature) && text.substr(mark_at) == mark;
}

std::vector<OwnPicture> own_pictures(const fs::path& folder) {
  std::vector<OwnPicture> found;
  std::error_code trouble;
  for (const auto& entry : fs::directory_iterator(folder, trouble)) {
    const auto number = frame_number(entry.path().filename().string());
    if (!number || !is_own_picture(entry.path())) continue;
    const auto bytes = entry.file_size(trouble);
    found.push_back({*number, trouble ? 0 : bytes});
  }
  std::sort(found.begin(), found.end(),
            [](const OwnPicture& a, const OwnPicture& b) { return a.number < b.number; });
  return found;
}

}  // namespace palpate::render
