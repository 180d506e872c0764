#pragma once
// Small images in every format that the importer reads, made byte by byte.

#include <array>
#include <cstdint>
#include <vector>

#include "tests/support/image/bytes.h"

namespace palpate::test {

/// One picture for all formats: 5 x 4 x 3 cells of 0.5 x 0.75 x 2 mm, every value different, some negative.
inline constexpr int nx = 5, ny = 4, nz = 3;
inline constexpr std::array<double, 3> spacing_mm = {0.5, 0.75, 2.0};  // exact in binary
inline constexpr std::int16_t value_at(int i, int j, int k) {
  return static_cast<std::int16_t>(-1000 + 7 * i + 100 * j + 1000 * k);
}
std::vector<std::int16_t> picture();

Bytes nifti();       // sform: identity in RAS, that is x to the right, y to the front
Bytes nrrd();        // space left-posterior-superior, identity
Bytes meta_image();  // with a TransformMatrix, identity
Bytes inr();         // INRIMAGE-4, signed fixed, 16 bits

/// One slice as explicit-VR little-endian DICOM: axial, at z = 10 mm + 2 mm k, stored value + 1024, slope 1, intercept -1024.
struct DicomSlice {
  int k = 0;
  std::string series = "1.2.826.0.1.3680043.2.1.1";
  double z_mm = 10;
  double shear_mm = 0;  // added to the x position
};
Bytes dicom(const DicomSlice& slice);

/// main.plist of an InVesalius project whose parts can be spoilt.
struct ProjectText {
  std::string shape = "<integer>3</integer><integer>4</integer><integer>5</integer>";
  std::string spacing = "<real>0.5</real><real>0.75</real><real>2.0</real>";
  std::string dtype = "int16";
  std::string orientation = "<key>orientation</key><integer>1</integer>";
};
Bytes main_plist(const ProjectText& text = {});
NamedBytes project_entries(const ProjectText& text = {});
Bytes inv3(const ProjectText& text = {});  // tar.gz

}  // namespace palpate::test
