#pragma once
// The header of MetaImage (.mha, .mhd).

#include <string>

#include "deploy/import/image_facts.h"

namespace palpate {

/// @throws InputError: not such a header, absurd size, spacing missing or senseless, fewer bytes than the cells need
ImageFacts check_meta_header(const std::string& path);

}  // namespace palpate
