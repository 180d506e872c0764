#pragma once
// A bar on a terminal, nothing elsewhere.

namespace palpate::deploy {

/// @param t        reached so far [s]
/// @param seconds  the whole [s]; the line ends when t reaches it
void show_progress(double t, double seconds);

}  // namespace palpate::deploy
