#pragma once
// The help over the picture: all keys and ways of the mouse, from the table that the window acts by.

namespace palpate::render {

/// Lays it out in the current ImGui frame, in the middle of the picture; scrolls where that is too low.
/// @param pointed  the mouse leads a tool: with the keys for it
/// @return true: the person closed it
bool lay_out_help(bool pointed, float scale);

}  // namespace palpate::render
