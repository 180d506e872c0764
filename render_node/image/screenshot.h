#pragma once
// Pictures that a person asks for: picture_0001.png and so on, beside whatever lies there.

#include <string>

#include "render_node/image/image.h"

namespace palpate::render {

/// Writes the picture under the first number that is free; nothing is ever written over.
/// @param folder  an existing one
/// @return the path written  @throws InputError if it cannot be written, or all 9,999 numbers are taken
std::string save_screenshot(const Image& image, const std::string& folder);

}  // namespace palpate::render
