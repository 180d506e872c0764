#include "physics_node/record/mend_record.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "common/error/error.h"
#include "common/record/dataset_list.h"
#include "common/record/hdf5_file.h"
#include "physics_node/record/xdmf.h"

namespace palpate::physics {
namespace {

bool is_cut_short(const std::string& path) {
  try {
    return Hdf5File(path, Hdf5File::Mode::read).cut_short();
  } catch (const std::runtime_error& none) {
    throw InputError(none.what());
  }
}

/// The bodies and times of a record, of what all of its series hold.
void write_xdmf_of(const std::filesystem::path& path) {
  const Hdf5File file(path.string(), Hdf5File::Mode::read);
  std::vector<XdmfBody> bodies;
  std::vector<double> times;
  for (const DatasetFacts& dataset : list_datasets(path.string())) {
    const std::filesystem::path at = dataset.path;
    if (!dataset.path.starts_with("/bodies/") || at.filename() != "position") continue;
    const std::string base = at.parent_path().string();
    const auto now = file.read<double>(base + "/time");
    bodies.push_back({.name = at.parent_path().filename().string(),
                      .n_masses = file.shape(base + "/rest").at(0),
                      .n_facets = file.shape(base + "/facets").at(0),
                      .n_rows = std::min(dataset.shape.at(0), file.shape(base + "/flags").at(0))});
    if (bodies.size() == 1) times = now;
    times.resize(std::min({times.size(), now.size(), static_cast<std::size_t>(bodies.back().n_rows)}));
  }
  if (!times.empty())
    write_xdmf((path.parent_path() / "record.xdmf").string(), path.filename().string(), bodies, times);
}

}  // namespace

bool mend_record(const std::string& path) {
  if (!is_cut_short(path)) return false;
  mend(path);
  write_xdmf_of(path);
  return true;
}

}  // namespace palpate::physics
