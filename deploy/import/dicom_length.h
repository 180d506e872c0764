#pragma once
// Is a DICOM file complete? The library silently pads missing cells with zeros, and crashes on some headers.
// Source: DICOM PS3.5, 7.1 and 7.5 (data elements, sequences), A.4 (encapsulated pixel data)

#include <string>

namespace palpate {

/// Walks over the elements of a DICOM file without believing their contents.
/// @throws InputError: ends before an element does, or before the pixel data
void check_dicom_length(const std::string& path);

}  // namespace palpate
