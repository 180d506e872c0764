#include "common/record/dataset_list.h"

#include <hdf5.h>

#include "common/error/error.h"
#include "common/record/hdf5_handle.h"

namespace palpate {
namespace {

/// Called by HDF5 for every object of the file; keeps the datasets.
herr_t note(hid_t file, const char* name, const H5O_info_t* info, void* list) {
  if (info->type != H5O_TYPE_DATASET) return 0;
  const hdf5::Handle dataset(H5Dopen2(file, name, H5P_DEFAULT), H5Dclose);
  if (!dataset.valid()) return -1;
  const hdf5::Handle space(H5Dget_space(dataset.get()), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank < 0) return -1;
  std::vector<hsize_t> shape(static_cast<std::size_t>(rank));
  if (rank > 0) H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr);
  auto& found = *static_cast<std::vector<DatasetFacts>*>(list);
  found.push_back({std::string("/") + name, {shape.begin(), shape.end()}});
  return 0;
}

}  // namespace

std::vector<DatasetFacts> list_datasets(const std::string& path) {
  hdf5::hush();
  bool cut_short = false;
  const hdf5::Handle file(hdf5::open_to_read(path, cut_short), H5Fclose);
  std::vector<DatasetFacts> found;
  if (!file.valid() || H5Ovisit2(file.get(), H5_INDEX_NAME, H5_ITER_INC, note, &found, H5O_INFO_BASIC) < 0) {
    throw InputError(path + ": is not an HDF5 file, or was cut short; write it again");
  }
  return found;
}

}  // namespace palpate
