#pragma once
// What datasets an HDF5 file holds, for a person who asks.

#include <cstdint>
#include <string>
#include <vector>

namespace palpate {

struct DatasetFacts {
  std::string path;                  // from the root, "/group/name"
  std::vector<std::uint64_t> shape;  // empty: a single value
};

/// All datasets, sorted by path. @throws InputError if the file cannot be opened as HDF5
std::vector<DatasetFacts> list_datasets(const std::string& path);

}  // namespace palpate
