#include "physics_node/record/vtp_file.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <fstream>
#include <numeric>
#include <stdexcept>

#include "common/record/part_file.h"

namespace palpate::physics {
namespace {

static_assert(std::endian::native == std::endian::little, "the files say byte_order=\"LittleEndian\"");

/// The data behind the XML: each array after its length in bytes.
class Appended {
 public:
  template <class T>
  std::string add(const char* type, const std::string& name, int components, const std::vector<T>& values,
                  const std::string& more = "") {
    const std::string element = fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\"{} format=\"appended\" "
        "offset=\"{}\"/>\n",
        type, name, components, more, bytes_.size());
    const std::uint64_t length = values.size() * sizeof(T);
    append(&length, sizeof length);
    append(values.data(), length);
    return element;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void append(const void* data, std::uint64_t length) {
    bytes_.append(static_cast<const char*>(data), length);
  }
  std::string bytes_;
};

std::uint64_t write_whole(const std::string& path, const std::string& text) {
  PartFile file(path);
  std::ofstream out(file.part(), std::ios::binary);
  out << text;
  out.close();
  if (!out) throw std::runtime_error(path + ": cannot be written; is the disk full?");
  file.commit();
  return text.size();
}

}  // namespace

std::uint64_t write_vtp(const std::string& path, const VtpMesh& mesh) {
  Appended data;
  const bool lone = mesh.ends.empty();
  std::vector<std::int32_t> each(lone ? mesh.n_points() : 0);
  std::iota(each.begin(), each.end(), 0);
  std::vector<std::int32_t> behind(each);
  for (auto& end : behind) ++end;
  const std::string cells = lone ? "Verts" : "Polys";
  std::string xml = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n"
      "<FieldData>\n{}</FieldData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\" NumberOfLines=\"0\" "
      "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n",
      data.add("Float64", "TimeValue", 1, std::vector<double>{mesh.t}, " NumberOfTuples=\"1\""),
      mesh.n_points(), each.size(), mesh.ends.size());
  xml += "<Points>\n" + data.add("Float32", "position", 3, mesh.points) + "</Points>\n<PointData>\n";
  for (const VtpArray& array : mesh.on_points)
    xml += data.add("Float32", array.name, array.components, array.values);
  xml += "</PointData>\n<CellData>\n";
  if (!mesh.rgb.empty()) xml += data.add("UInt8", "colour", 3, mesh.rgb);
  xml += "</CellData>\n<" + cells + ">\n" + data.add("Int32", "connectivity", 1, lone ? each : mesh.corners) +
         data.add("Int32", "offsets", 1, lone ? behind : mesh.ends) + "</" + cells +
         ">\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
  return write_whole(path, xml + data.bytes() + "\n</AppendedData>\n</VTKFile>\n");
}

void write_pvd(const std::string& path, const std::vector<PvdPart>& parts) {
  std::string xml =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const PvdPart& part : parts)
    xml +=
        fmt::format("<DataSet timestep=\"{:.9g}\" part=\"{}\" file=\"{}\"/>\n", part.t, part.part, part.file);
  write_whole(path, xml + "</Collection>\n</VTKFile>\n");
}

}  // namespace palpate::physics
