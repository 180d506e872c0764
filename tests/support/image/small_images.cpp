#include "tests/support/image/small_images.h"

#include <fmt/format.h>

namespace palpate::test {
namespace {

/// One explicit-VR element. Values are padded to an even length as the standard asks.
Bytes element(std::uint16_t group, std::uint16_t number, const std::string& vr, Bytes value) {
  if (value.size() % 2 != 0) value += vr == "UI" ? '\0' : ' ';
  Bytes bytes = bytes_of(group) + bytes_of(number) + vr;
  if (vr == "OB" || vr == "OW") {
    bytes += bytes_of(std::uint16_t{0}) + bytes_of(static_cast<std::uint32_t>(value.size()));
  } else {
    bytes += bytes_of(static_cast<std::uint16_t>(value.size()));
  }
  return bytes + value;
}

Bytes element(std::uint16_t group, std::uint16_t number, std::uint16_t value) {
  return element(group, number, "US", bytes_of(value));
}

Bytes pixels_of_slice(int k) {
  std::vector<std::uint16_t> stored;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) stored.push_back(static_cast<std::uint16_t>(value_at(i, j, k) + 1024));
  return bytes_of(stored);
}

}  // namespace

std::vector<std::int16_t> picture() {
  std::vector<std::int16_t> values;
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) values.push_back(value_at(i, j, k));
  return values;
}

Bytes nifti() {
  Bytes bytes(352, '\0');
  put<std::int32_t>(bytes, 0, 348);
  const std::array<std::int16_t, 8> dim = {3, nx, ny, nz, 1, 1, 1, 1};
  for (std::size_t i = 0; i < 8; ++i) put<std::int16_t>(bytes, 40 + 2 * i, dim[i]);
  put<std::int16_t>(bytes, 70, 4);   // int16
  put<std::int16_t>(bytes, 72, 16);  // bits
  put<float>(bytes, 76, 1.0f);
  for (std::size_t i = 0; i < 3; ++i) {
    put<float>(bytes, 80 + 4 * i, static_cast<float>(spacing_mm[i]));
    put<float>(bytes, 280 + 20 * i, static_cast<float>(spacing_mm[i]));  // diagonal of srow_x, srow_y, srow_z
  }
  put<float>(bytes, 108, 352.0f);    // where the cells begin
  put<float>(bytes, 112, 1.0f);      // slope
  put<char>(bytes, 123, 2);          // millimetres
  put<std::int16_t>(bytes, 254, 1);  // sform
  bytes.replace(344, 4, Bytes("n+1\0", 4));
  return bytes + bytes_of(picture());
}

Bytes nrrd() {
  return "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 5 4 3\n"
         "space directions: (0.5,0,0) (0,0.75,0) (0,0,2)\nkinds: domain domain domain\nendian: little\n"
         "encoding: raw\nspace origin: (1,2,3)\n\n" +
         bytes_of(picture());
}

Bytes meta_image() {
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = "
         "False\n"
         "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 1 2 3\nElementSpacing = 0.5 0.75 2\nDimSize = 5 4 3\n"
         "ElementType = MET_SHORT\nElementDataFile = LOCAL\n" +
         bytes_of(picture());
}

Bytes inr() {
  Bytes header =
      "#INRIMAGE-4#{\nXDIM=5\nYDIM=4\nZDIM=3\nVDIM=1\nTYPE=signed fixed\nPIXSIZE=16 bits\nCPU=decm\n"
      "VX=0.5\nVY=0.75\nVZ=2\n";
  header.append(252 - header.size(), '\n');
  return header + "##}\n" + bytes_of(picture());
}

Bytes dicom(const DicomSlice& slice) {
  const std::string kind = "1.2.840.10008.5.1.4.1.1.2",
                    name = fmt::format("{}.{}", slice.series, slice.k + 1);
  const Bytes meta = element(2, 1, "OB", Bytes("\0\1", 2)) + element(2, 2, "UI", kind) +
                     element(2, 3, "UI", name) + element(2, 0x10, "UI", "1.2.840.10008.1.2.1") +
                     element(2, 0x12, "UI", "1.2.826.0.1.3680043.2.1");
  return Bytes(128, '\0') + "DICM" + element(2, 0, "UL", bytes_of(static_cast<std::uint32_t>(meta.size()))) +
         meta + element(8, 0x16, "UI", kind) + element(8, 0x18, "UI", name) + element(8, 0x60, "CS", "CT") +
         element(0x18, 0x50, "DS", "2") + element(0x20, 0xd, "UI", "1.2.826.0.1.3680043.2.1") +
         element(0x20, 0xe, "UI", slice.series) + element(0x20, 0x13, "IS", std::to_string(nz - slice.k)) +
         element(0x20, 0x32, "DS", fmt::format("{}\\2\\{}", 1 + slice.shear_mm, slice.z_mm)) +
         element(0x20, 0x37, "DS", "1\\0\\0\\0\\1\\0") + element(0x28, 2, 1) +
         element(0x28, 4, "CS", "MONOCHROME2") + element(0x28, 0x10, ny) + element(0x28, 0x11, nx) +
         element(0x28, 0x30, "DS", "0.75\\0.5") + element(0x28, 0x100, 16) + element(0x28, 0x101, 16) +
         element(0x28, 0x102, 15) + element(0x28, 0x103, 0) + element(0x28, 0x1052, "DS", "-1024") +
         element(0x28, 0x1053, "DS", "1") + element(0x7fe0, 0x10, "OW", pixels_of_slice(slice.k));
}

Bytes main_plist(const ProjectText& text) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<plist "
         "version=\"1.0\"><dict><key>format_version</key><integer>1"
         "</integer><key>matrix</key><dict><key>dtype</key><string>" +
         text.dtype + "</string><key>filename</key><string>matrix.dat</string><key>shape</key><array>" +
         text.shape + "</array></dict>" + text.orientation + "<key>spacing</key><array>" + text.spacing +
         "</array></dict></plist>\n";
}

NamedBytes project_entries(const ProjectText& text) {
  return {{"tmpabc/main.plist", main_plist(text)}, {"tmpabc/matrix.dat", bytes_of(picture())}};
}

Bytes inv3(const ProjectText& text) { return gzipped(tarred(project_entries(text))); }

}  // namespace palpate::test
