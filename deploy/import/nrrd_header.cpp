#include "deploy/import/nrrd_header.h"

#include <Eigen/Core>

#include "common/error/error.h"
#include "deploy/import/text_header.h"

namespace palpate {
namespace {

std::vector<double> spacings_of(const TextHeader& header) {
  std::vector<double> mm;
  if (const std::string* directions = header.find({"space directions"})) {
    const auto v = numbers_of(*directions);
    for (std::size_t i = 0; i + 2 < v.size(); i += 3)
      mm.push_back(Eigen::Vector3d(v[i], v[i + 1], v[i + 2]).norm());
  } else if (const std::string* spacings = header.find({"spacings"})) {
    mm = numbers_of(*spacings);
  }
  return mm;
}

}  // namespace

ImageFacts check_nrrd_header(const std::string& path) {
  const TextHeader header = read_text_header(path, ':', "");
  const std::string* sizes = header.find({"sizes"});
  if (sizes == nullptr)
    throw InputError(path + ": is not NRRD, or is truncated; name a whole .nrrd or .nhdr file");
  const std::uint64_t cells = check_sizes(path, sizes, "sizes");
  check_spacings(path, spacings_of(header));
  ImageFacts facts;
  const std::string* space = header.find({"space"});
  const std::string name = space == nullptr ? "" : lower(*space);
  facts.oriented = name == "lps" || name == "ras" || name == "las" || name.ends_with("-superior");
  if (const std::string* data = header.find({"data file", "datafile"}))
    facts.data_file = file_beside(path, *data);
  // At least a byte a cell; the library itself notices when less than the exact number is there.
  const std::string* encoding = header.find({"encoding"});
  CellStore store;
  store.file = facts.data_file.empty() ? path : facts.data_file;
  store.offset = facts.data_file.empty() ? header.bytes : 0;
  store.bytes = cells;
  store.deflated = encoding != nullptr && lower(*encoding) != "raw";
  check_holds(path, store);
  return facts;
}

}  // namespace palpate
