#pragma once
// Which kind of image is it? By its name; a folder, and a file without a telling name, by looking.

#include <string>

namespace palpate {

enum class ImageFormat { inv3, nifti, nrrd, meta, dicom, raw, inr };

/// @throws InputError: missing, empty, not a file or folder, of no known kind
ImageFormat image_format_of(const std::string& path);

/// A file that ends in .dcm, or has "DICM" after its first 128 bytes, and is not the index DICOMDIR.
bool looks_like_dicom(const std::string& path);

}  // namespace palpate
