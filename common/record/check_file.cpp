#include "common/record/check_file.h"

#include <algorithm>

#include "common/error/error.h"
#include "common/record/dataset_list.h"
#include "common/record/hdf5_file.h"

namespace palpate {
namespace {

constexpr std::uint64_t block_numbers = 1 << 20;  // read at once
constexpr std::uint64_t row_limit = 1 << 28;      // numbers of a row. Why: three of each of 9e7 masses

}  // namespace

void check_file(const std::string& path) {
  try {
    const Hdf5File file(path, Hdf5File::Mode::read);
    for (const DatasetFacts& dataset : list_datasets(path)) {
      if (dataset.shape.empty()) continue;
      std::uint64_t row = 1;
      for (std::size_t axis = 1; axis < dataset.shape.size(); ++axis) row *= dataset.shape[axis];
      if (row > row_limit)
        throw InputError(path + ": dataset " + dataset.path +
                         " has more in a row than any record; it is damaged");
      const std::uint64_t at_once =
          std::max<std::uint64_t>(1, block_numbers / std::max<std::uint64_t>(1, row));
      for (std::uint64_t first = 0; first < dataset.shape[0]; first += at_once)
        file.read_rows<double>(dataset.path, first, std::min(at_once, dataset.shape[0] - first));
    }
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& damaged) {
    throw InputError(damaged.what());
  }
}

}  // namespace palpate
