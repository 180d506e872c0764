#pragma once
// The binary header of NIfTI-1 (.nii, .nii.gz), as far as it must be checked before a library reads the file: it would
// take a zero spacing for 1 mm, and memory for whatever size the header claims.
// Source: nifti.nimh.nih.gov, nifti1.h

#include <string>

#include "deploy/import/image_facts.h"

namespace palpate {

/// @throws InputError: not NIfTI-1, not three-dimensional, absurd size or spacing, fewer bytes than the cells need
ImageFacts check_nifti_header(const std::string& path);

}  // namespace palpate
