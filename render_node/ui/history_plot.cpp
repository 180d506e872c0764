#include "render_node/ui/history_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace palpate::render {
namespace {

const ImU32 hand_colour = IM_COL32(28, 98, 178, 255);
const ImU32 tissue_colour = IM_COL32(226, 96, 24, 255);
const std::array<ImU32, 3> axis_colours{IM_COL32(196, 48, 48, 255), IM_COL32(40, 140, 70, 255),
                                        IM_COL32(50, 90, 200, 255)};
const ImU32 grid_colour = IM_COL32(205, 211, 219, 255);
constexpr double per_milli = 1e3;

struct Axes {
  ImVec2 corner, size;         // top left, extent [px]
  double bottom = 0, top = 1;  // as written
  ImVec2 at(double age, double value) const {
    const double x = 1.0 - age / History::span_s, y = (top - value) / (top - bottom);
    return {corner.x + size.x * static_cast<float>(x), corner.y + size.y * static_cast<float>(y)};
  }
};

void draw_grid(ImDrawList& list, const Axes& axes) {
  const ImU32 text = ImGui::GetColorU32(ImGuiCol_TextDisabled);
  const float line = ImGui::GetFontSize();
  for (int i = 0; i <= 2; ++i) {
    const double value = axes.bottom + (axes.top - axes.bottom) * i / 2;
    const ImVec2 left = axes.at(History::span_s, value);
    list.AddLine(left, axes.at(0, value), grid_colour);
    const std::string words = fmt::format("{:g}", value);
    const float width = ImGui::CalcTextSize(words.c_str()).x;
    list.AddText({left.x - width - 0.4F * line, left.y - 0.55F * line}, text, words.c_str());
  }
  for (const double age : {10.0, 5.0, 0.0}) {
    const ImVec2 foot = axes.at(age, axes.bottom);
    list.AddLine(axes.at(age, axes.top), foot, grid_colour);
    const std::string words = age > 0 ? fmt::format("\xe2\x80\x93{:g} s", age) : std::string("now");
    const float width = ImGui::CalcTextSize(words.c_str()).x;
    list.AddText({foot.x - width * (age == 10  ? 0.3F
                                    : age == 5 ? 0.5F
                                               : 1.0F),
                  foot.y + 0.2F * line},
                 text, words.c_str());
  }
}

void draw_history(ImDrawList& list, const Axes& axes, const PlotLine& what, double now, double per_unit) {
  std::vector<ImVec2> line;
  for (const auto& point : what.history->points(now))
    line.push_back(axes.at(point.age, per_unit * point.value));
  const float width = ImGui::GetFontSize() * 0.12F;
  list.AddPolyline(line.data(), static_cast<int>(line.size()), what.colour, ImDrawFlags_None, width);
  if (!line.empty()) list.AddCircleFilled(line.back(), 1.7F * width, what.colour);
}

void legend(const char* words, ImU32 colour) {
  const float size = ImGui::GetFontSize();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + 0.45F * size}, {at.x + size, at.y + 0.65F * size},
                                            colour);
  ImGui::Dummy({size, size});
  ImGui::SameLine();
  ImGui::TextUnformatted(words);
}

}  // namespace

double axis_top(double value) {
  if (value <= 0.1) return 0.1;
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 3.0, 4.0, 6.0, 8.0}) {
    if (value <= step * decade * (1 + 1e-9)) return step * decade;
  }
  return 10 * decade;
}

double newest_of(std::span<const PlotLine> lines) {
  double newest = 0;
  for (const auto& what : lines)
    if (!what.history->empty()) newest = std::max(newest, what.history->newest());
  return newest;
}

void history_plot(std::span<const PlotLine> lines, const char* unit, double per_unit, float height) {
  const float line = ImGui::GetFontSize();
  double peak = 0;
  bool below = false, any = false;
  const double now = newest_of(lines);
  for (const auto& what : lines) {
    if (what.history->empty()) continue;
    if (any) ImGui::SameLine(0, line);
    any = true;
    legend(what.words, what.colour);
    peak = std::max(peak, per_unit * what.history->peak());
    for (const auto& point : what.history->points(now)) below = below || point.value < 0;
  }
  if (any) ImGui::SameLine();
  const float end = ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(unit).x;
  ImGui::SetCursorPosX(end);
  ImGui::TextDisabled("%s", unit);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float free = ImGui::GetContentRegionAvail().x;
  const float left = 2.4F * line;
  const double top = axis_top(peak);
  const Axes axes{{corner.x + left, corner.y + 0.6F * line},
                  {free - left - 0.3F * line, height - 2.2F * line},
                  below ? -top : 0,
                  top};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  draw_grid(list, axes);
  for (const auto& what : lines) draw_history(list, axes, what, now, per_unit);
  ImGui::Dummy({free, height});
}

void force_plot(const ToolView& tool, float height) {
  const std::array<PlotLine, 2> lines{
      {{&tool.on_tool, tissue_colour, "by tissue"}, {&tool.on_hand, hand_colour, "on hand"}}};
  history_plot(lines, "N", 1, height);
}

bool shows_moments(const ToolView& tool) {
  return std::any_of(tool.moment_history.begin(), tool.moment_history.end(),
                     [](const History& axis) { return axis.peak() != 0; });
}

void moment_plot(const ToolView& tool, float height) {
  if (!shows_moments(tool)) return;
  const auto& moment = tool.moment_history;
  const std::array<PlotLine, 3> lines{{{&moment[0], axis_colours[0], "about x"},
                                       {&moment[1], axis_colours[1], "y"},
                                       {&moment[2], axis_colours[2], "z"}}};
  history_plot(lines, "mN m", per_milli, height);
}

}  // namespace palpate::render
