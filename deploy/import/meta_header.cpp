#include "deploy/import/meta_header.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "common/error/error.h"
#include "deploy/import/inflated_length.h"
#include "deploy/import/text_header.h"

namespace palpate {
namespace {

constexpr std::array<std::pair<std::string_view, std::uint64_t>, 10> types = {{{"met_char", 1},
                                                                               {"met_uchar", 1},
                                                                               {"met_short", 2},
                                                                               {"met_ushort", 2},
                                                                               {"met_int", 4},
                                                                               {"met_uint", 4},
                                                                               {"met_long", 4},
                                                                               {"met_ulong", 4},
                                                                               {"met_float", 4},
                                                                               {"met_double", 8}}};

std::uint64_t bytes_of_cell(const std::string& path, const TextHeader& header) {
  const std::string* name = header.find({"elementtype"});
  const std::string type = name == nullptr ? "" : lower(*name);
  for (const auto& [known, bytes] : types)
    if (type == known) return bytes;
  throw InputError(path + ": cells of type \"" + type +
                   "\" are not read; MET_SHORT, MET_UCHAR, MET_FLOAT and such are");
}

std::uint64_t channels_of(const TextHeader& header) {
  const std::string* text = header.find({"elementnumberofchannels"});
  const auto n = text == nullptr ? std::vector<double>{1} : numbers_of(*text);
  return n.size() == 1 && n[0] >= 1 && n[0] <= 16 ? static_cast<std::uint64_t>(n[0]) : 1;
}

bool is_true(const std::string* value) { return value != nullptr && lower(*value).starts_with('t'); }

/// The library leaves what is missing of the cells at whatever the memory held, so look first.
void check_cells(const std::string& path, const TextHeader& header, CellStore store) {
  if (!is_true(header.find({"binarydata"})))
    throw InputError(path + ": its cells are text; write them with BinaryData = True");
  store.deflated = is_true(header.find({"compresseddata"}));
  check_holds(path, store);
  if (!store.deflated) return;
  const std::string* size = header.find({"compresseddatasize"});
  const auto bytes = size == nullptr ? std::vector<double>{} : numbers_of(*size);
  const bool sound = bytes.size() == 1 && bytes[0] > 0 && bytes[0] <= 1e12;
  const auto length =
      sound ? inflated_length(store.file, store.offset, static_cast<std::uint64_t>(bytes[0])) : std::nullopt;
  if (length != store.bytes)
    throw InputError(
        path +
        ": its compressed cells are damaged, truncated or without CompressedDataSize; fetch a whole copy");
}

}  // namespace

ImageFacts check_meta_header(const std::string& path) {
  const TextHeader header = read_text_header(path, '=', "elementdatafile");
  const std::string* data = header.find({"elementdatafile"});
  if (data == nullptr)
    throw InputError(path + ": is not a MetaImage, or is truncated; name a whole .mha or .mhd file");
  const std::uint64_t cells = check_sizes(path, header.find({"dimsize"}), "DimSize");
  const std::string* spacing = header.find({"elementspacing", "elementsize"});
  check_spacings(path, spacing == nullptr ? std::vector<double>{} : numbers_of(*spacing));
  ImageFacts facts;
  facts.oriented = header.find({"transformmatrix", "rotation", "orientation"}) != nullptr;
  if (lower(*data) != "local") facts.data_file = file_beside(path, *data);
  CellStore store;
  store.file = facts.data_file.empty() ? path : facts.data_file;
  store.offset = facts.data_file.empty() ? header.bytes : 0;
  store.bytes = cells * bytes_of_cell(path, header) * channels_of(header);
  check_cells(path, header, store);
  return facts;
}

}  // namespace palpate
