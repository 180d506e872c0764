#pragma once
// Words over the picture, beside the column.

#include <string>
#include <vector>

namespace palpate::render {

/// What hinders the hand (notices.h), in the middle of the free part of the picture. Nothing where there are no lines.
/// @param left  covered by the column [px]
void lay_out_hindrances(const std::vector<std::string>& lines, float left);
/// Words over the picture, at its upper edge; nothing where there are none. @param left  covered by the column [px]
void lay_out_words(const std::string& words, float left);

}  // namespace palpate::render
