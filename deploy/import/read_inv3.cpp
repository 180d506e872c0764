#include "deploy/import/read_inv3.h"

#include <charconv>
#include <limits>

#include "common/error/error.h"
#include "common/math/units.h"
#include "common/record/volume_check.h"
#include "deploy/import/property_list.h"
#include "deploy/import/read_cells.h"

namespace palpate {
namespace {

constexpr std::int64_t plist_bytes_limit = 1'000'000;

/// What main.plist says about the matrix.
struct Project {
  CellLayout layout;
  Eigen::Vector3d spacing;
  std::string matrix;  // name of the entry
  bool axial = false;
};

std::string text_of_entry(const std::string& path, const std::string& name) {
  ByteStream archive(path, ByteStream::Kind::tar);
  while (const auto entry = archive.next()) {
    if (entry->name != name) continue;
    if (entry->bytes < 0 || entry->bytes > plist_bytes_limit)
      throw InputError(path + ": its " + name + " is absurdly long; save it anew in InVesalius");
    std::string text(static_cast<std::size_t>(entry->bytes), '\0');
    text.resize(archive.read(reinterpret_cast<unsigned char*>(text.data()), text.size()));
    return text;
  }
  throw InputError(path + ": holds no " + name + "; name a project saved by InVesalius");
}

const PropertyList& entry_of(const std::string& where, const PropertyList& list, const std::string& key) {
  const auto found = list.entries.find(key);
  if (found == list.entries.end())
    throw InputError(where + ": lacks \"" + key + "\"; save it anew in InVesalius");
  return found->second;
}

double number_of(const std::string& where, const PropertyList& value) {
  double number = std::numeric_limits<double>::quiet_NaN();
  const char* end = value.text.data() + value.text.size();
  const auto result = std::from_chars(value.text.data(), end, number);
  if (result.ec != std::errc() || result.ptr != end)
    throw InputError(where + ": \"" + value.text + "\" is not a number; save it anew in InVesalius");
  return number;
}

std::array<double, 3> three_of(const std::string& where, const PropertyList& list, const std::string& key) {
  const auto& items = entry_of(where, list, key).items;
  if (items.size() != 3)
    throw InputError(where + ": \"" + key + "\" should be three numbers; save it anew in InVesalius");
  return {number_of(where, items[0]), number_of(where, items[1]), number_of(where, items[2])};
}

std::array<int, 3> size_of_shape(const std::string& where, const std::array<double, 3>& shape) {
  std::array<std::int64_t, 3> size{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double n = shape[2 - axis];  // slices first
    size[axis] = n >= 1 && n <= 1e9 ? static_cast<std::int64_t>(n) : 0;
  }
  return check_size(where, size);
}

Project read_project(const std::string& path) {
  const std::string where = path + ": main.plist";
  const PropertyList plist = parse_property_list(where, text_of_entry(path, "main.plist"));
  const PropertyList& matrix = entry_of(where, plist, "matrix");
  Project project;
  project.matrix = entry_of(where, matrix, "filename").text;
  project.layout.size = size_of_shape(where, three_of(where, matrix, "shape"));
  const std::string& dtype = entry_of(where, matrix, "dtype").text;
  const auto type = voxel_type_named(dtype);
  if (!type)
    throw InputError(where + ": cells of type \"" + dtype + "\"; int16, uint8, uint16 and float32 are read");
  project.layout.type = *type;
  const auto spacing = three_of(where, plist, "spacing");
  for (int axis = 0; axis < 3; ++axis)
    project.spacing[axis] = m_from_mm(spacing[static_cast<std::size_t>(axis)]);
  check_spacing(where, project.spacing);
  const auto orientation = plist.entries.find("orientation");
  project.axial = orientation != plist.entries.end() && orientation->second.text == "1";
  return project;
}

std::vector<float> read_matrix(const std::string& path, const Project& project) {
  const std::string where = path + ": " + project.matrix;
  ByteStream archive(path, ByteStream::Kind::tar);
  std::vector<float> cells;
  bool found = false;
  while (const auto entry =
             archive.next()) {  // to the end, so that a truncated archive is noticed wherever it ends
    if (found || entry->name != project.matrix) continue;
    cells = read_cells(archive, where, project.layout);
    found = true;
  }
  if (!found) throw InputError(where + ": is not in the archive; save the project anew in InVesalius");
  return cells;
}

}  // namespace

Volume read_inv3(const std::string& path) {
  const Project project = read_project(path);
  Volume volume;
  volume.size = project.layout.size;
  volume.spacing = project.spacing;
  if (project.axial) volume.orientation = Eigen::Vector3d(1, -1, 1).asDiagonal().toDenseMatrix();
  volume.intensity = read_matrix(path, project);
  return volume;
}

}  // namespace palpate
