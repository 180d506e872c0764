#pragma once
// Draws the plots of a session with the Python program plot_run.py.

#include <filesystem>

namespace palpate::deploy {

/// Debian's own Python: the one that python3-matplotlib belongs to.
std::filesystem::path plot_interpreter();

/// The plotter, or an empty path where it is not installed.
std::filesystem::path plotter_program();

/// Draws DIR/force.png, and DIR/energy.png where DIR has energies. Says on stderr, in one line, what hinders it.
/// @return true if all went well
bool draw_plots(const std::filesystem::path& folder);

/// Names on stdout the plots that are in DIR, one line each; one line, too, where there is nothing to draw.
void say_plots(const std::filesystem::path& folder);

}  // namespace palpate::deploy
