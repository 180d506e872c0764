#pragma once
// The header of NRRD (.nrrd, .nhdr).
// Source: teem.sourceforge.net/nrrd/format.html

#include <string>

#include "deploy/import/image_facts.h"

namespace palpate {

/// @throws InputError: not such a header, absurd size, spacing missing or senseless, fewer bytes than the cells need
ImageFacts check_nrrd_header(const std::string& path);

}  // namespace palpate
