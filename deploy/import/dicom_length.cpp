#include "deploy/import/dicom_length.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "common/error/error.h"

namespace palpate {
namespace {

constexpr std::uint32_t undefined = 0xFFFFFFFF, pixel_data = 0x7FE00010, item = 0xFFFEE000,
                        item_end = 0xFFFEE00D, sequence_end = 0xFFFEE0DD, transfer_syntax = 0x00020010;

/// What the walk ends with. `unknown`: written in a way that this walk does not follow.
enum class Found { all, too_short, unknown };

class Walk {
 public:
  explicit Walk(const std::string& path)
      : file_(path, std::ios::binary), end_(static_cast<std::int64_t>(std::filesystem::file_size(path))) {}

  Found run() {
    file_.seekg(128);
    if (text(4) != "DICM") return file_ ? Found::unknown : Found::too_short;
    std::int64_t at = 132;
    while (at < end_) {
      const Element element = next(at);
      if (!file_) return Found::too_short;
      if (element.value > end_) return Found::too_short;
      if (element.tag == transfer_syntax && !follow(element)) return Found::unknown;
      if (element.tag == pixel_data && element.bytes != undefined)
        return element.value + element.bytes <= end_ ? Found::all : Found::too_short;
      if (element.tag == pixel_data) return fragments(element.value);
      // Into sequences and items of undefined length, over everything else.
      if (element.unknown_inside) return Found::unknown;
      at = element.value +
           (element.bytes == undefined || element.tag == item ? 0 : std::int64_t{element.bytes});
    }
    return Found::too_short;  // no pixel data at all
  }

 private:
  struct Element {
    std::uint32_t tag = 0, bytes = 0;
    std::int64_t value = 0;  // where it begins
    bool unknown_inside = false;
  };

  std::uint32_t number(int bytes) {
    std::array<unsigned char, 4> raw{};
    file_.read(reinterpret_cast<char*>(raw.data()), bytes);
    std::uint32_t value = 0;
    for (int i = bytes; i-- > 0;) value = value << 8 | raw[static_cast<std::size_t>(i)];
    return value;
  }

  std::string text(std::size_t n) {
    std::string result(n, '\0');
    file_.read(result.data(), static_cast<std::streamsize>(n));
    return result;
  }

  Element next(std::int64_t at) {
    file_.seekg(at);
    Element element;
    const std::uint32_t group = number(2);
    element.tag = group << 16 | number(2);
    const bool bare = element.tag == item || element.tag == item_end || element.tag == sequence_end;
    if (bare || (!explicit_ && group != 2)) {
      element.bytes = number(4);
      element.value = at + 8;
      return element;
    }
    const std::string vr = text(2);
    const bool wide =
        std::string_view("OB OD OF OL OV OW SQ SV UC UN UR UT UV").find(vr) != std::string_view::npos;
    if (wide) number(2);
    element.bytes = number(wide ? 4 : 2);
    element.value = at + (wide ? 12 : 8);
    element.unknown_inside = vr == "UN" && element.bytes == undefined;
    return element;
  }

  /// Learns how the rest is written. False: deflated or big-endian.
  bool follow(const Element& element) {
    file_.seekg(element.value);
    const std::string uid = text(std::min<std::uint32_t>(element.bytes, 64)).c_str();
    explicit_ = uid != "1.2.840.10008.1.2";
    return uid != "1.2.840.10008.1.2.1.99" && uid != "1.2.840.10008.1.2.2";
  }

  Found fragments(std::int64_t at) {
    while (at + 8 <= end_) {
      const Element element = next(at);
      if (element.tag == sequence_end) return Found::all;
      if (element.tag != item) return Found::too_short;
      at = element.value + std::int64_t{element.bytes};
    }
    return Found::too_short;
  }

  std::ifstream file_;
  std::int64_t end_;
  bool explicit_ = true;
};

}  // namespace

void check_dicom_length(const std::string& path) {
  if (Walk(path).run() == Found::too_short)
    throw InputError(path + ": ends before its pixel data do; fetch a whole copy, or move it away");
}

}  // namespace palpate
