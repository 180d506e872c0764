#pragma once
// The text headers of MetaImage (.mha, .mhd) and NRRD (.nrrd, .nhdr), as far as they must be checked before a library
// reads the file: it would take a missing spacing for 1 mm, and memory for whatever size the header claims.

#include <string>

#include "deploy/import/image_facts.h"

namespace palpate {

/// @throws InputError: not such a header, absurd size, spacing missing, zero, negative or not a number
ImageFacts check_meta_header(const std::string& path);
ImageFacts check_nrrd_header(const std::string& path);

}  // namespace palpate
