#pragma once
// Surfaces and points as VTK's own XML files (.vtp), and a series of them (.pvd), which ParaView opens by a double click and
// VTK reads with vtkXMLPolyDataReader. Why written here: VTK itself would be 300 MB of packages on the PC of the tissue, for
// two hundred lines of text and numbers.
// Source: "VTK XML Formats", docs.vtk.org; version 1.0, appended raw data, 64-bit lengths.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace palpate::physics {

struct VtpArray {
  std::string name;  // as a viewer shows it: without "<", "&" and quotes
  int components = 1;
  std::vector<float> values;  // (n_points x components)
};

struct VtpMesh {
  std::vector<float> points;  // [m]                    (n_points x 3)
  /// Corners of the polygons, one after the other, and where each polygon ends among them. No polygons: lone points.
  std::vector<std::int32_t> corners, ends;
  std::vector<std::uint8_t> rgb;  // of the polygons, "colour"; EMPTY: none (n_polygons x 3)
  std::vector<VtpArray> on_points;
  double t = 0;  // [s], "TimeValue"

  std::size_t n_points() const { return points.size() / 3; }
};

/// Whole or not at all. @return bytes  @throws InputError: not a place to write; std::runtime_error: disk full
std::uint64_t write_vtp(const std::string& path, const VtpMesh& mesh);

struct PvdPart {
  double t = 0;
  int part = 0;      // of the bodies, tools and scenery at that time
  std::string file;  // relative to the collection
};
void write_pvd(const std::string& path, const std::vector<PvdPart>& parts);

}  // namespace palpate::physics
