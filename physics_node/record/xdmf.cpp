#include "physics_node/record/xdmf.h"

#include <fmt/format.h>

#include <fstream>
#include <stdexcept>

#include "common/record/part_file.h"

namespace palpate::physics {
namespace {

/// Row `step` of a series whose rows have the shape n x width.
std::string series_item(const std::string& hdf5, const std::string& path, std::uint64_t n_rows,
                        std::size_t step, std::uint64_t n, int width, const char* type) {
  const bool flat = width == 1;
  const std::string shape = flat ? fmt::format("{}", n) : fmt::format("{} {}", n, width);
  const std::string rank = flat ? "2" : "3";
  const std::string slab =
      flat ? fmt::format("{} 0 1 1 1 {}", step, n) : fmt::format("{} 0 0 1 1 1 1 {} {}", step, n, width);
  return fmt::format(
      "<DataItem ItemType=\"HyperSlab\" Dimensions=\"{0}\" Type=\"HyperSlab\">"
      "<DataItem Dimensions=\"3 {1}\" Format=\"XML\">{2}</DataItem>"
      "<DataItem {3} Dimensions=\"{4} {0}\" Format=\"HDF\">{5}:{6}</DataItem></DataItem>",
      shape, rank, slab, type, n_rows, hdf5, path);
}

std::string body_grid(const std::string& hdf5, const XdmfBody& body, std::size_t step, double t) {
  const std::string base = "/bodies/" + body.name;
  return fmt::format(
      "  <Grid Name=\"{0}\"><Time Value=\"{1:.9g}\"/>\n"
      "   <Topology TopologyType=\"Quadrilateral\" NumberOfElements=\"{2}\"><DataItem NumberType=\"UInt\" "
      "Precision=\"4\" "
      "Dimensions=\"{2} 4\" Format=\"HDF\">{3}:{4}/facets</DataItem></Topology>\n"
      "   <Geometry GeometryType=\"XYZ\">{5}</Geometry>\n"
      "   <Attribute Name=\"flags\" AttributeType=\"Scalar\" Center=\"Node\">{6}</Attribute>\n"
      "  </Grid>\n",
      body.name, t, body.n_facets, hdf5, base,
      series_item(hdf5, base + "/position", body.n_rows, step, body.n_masses, 3,
                  "NumberType=\"Float\" Precision=\"4\""),
      series_item(hdf5, base + "/flags", body.n_rows, step, body.n_masses, 1,
                  "NumberType=\"UChar\" Precision=\"1\""));
}

}  // namespace

void write_xdmf(const std::string& path, const std::string& hdf5, const std::vector<XdmfBody>& bodies,
                const std::vector<double>& times) {
  PartFile file(path);
  std::ofstream out(file.part());
  out << "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\"><Domain>\n"
         "<Grid Name=\"palpate\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::size_t step = 0; step < times.size(); ++step) {
    out << fmt::format(
        " <Grid Name=\"bodies\" GridType=\"Collection\" CollectionType=\"Spatial\"><Time "
        "Value=\"{:.9g}\"/>\n",
        times[step]);
    for (const XdmfBody& body : bodies) out << body_grid(hdf5, body, step, times[step]);
    out << " </Grid>\n";
  }
  out << "</Grid>\n</Domain></Xdmf>\n";
  out.flush();
  if (!out) throw std::runtime_error(path + ": cannot be written; is the disk full?");
  file.commit();
}

}  // namespace palpate::physics
