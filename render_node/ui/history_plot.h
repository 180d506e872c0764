#pragma once
// Live plots against the last ten seconds of the hand's clock, on which all lines of a tool are (model/hand_clock.h).

#include <imgui.h>

#include <span>

#include "render_node/model/view_model.h"

namespace palpate::render {

/// A line of a plot: what, its colour, and its words in the legend.
struct PlotLine {
  const History* history = nullptr;
  ImU32 colour = 0;
  const char* words = "";
};

/// The time that is "now" in a plot of these lines, one for all: of the newest value among them [s].
double newest_of(std::span<const PlotLine> lines);

/// Lays a plot out in the current ImGui window, over its free width. Its axis goes below zero where a value does.
/// @param lines  those without a value are left out  @param unit  in which values times `per_unit` are written
/// @param height [px]
void history_plot(std::span<const PlotLine> lines, const char* unit, double per_unit, float height);

/// Force on hand and tool.
void force_plot(const ToolView& tool, float height);
/// Is there a moment to plot?
bool shows_moments(const ToolView& tool);
/// Moment about the axes; nothing where there is none.
void moment_plot(const ToolView& tool, float height);

/// A round number not below `value` for the top of an axis; at least 0.1.
double axis_top(double value);

}  // namespace palpate::render
