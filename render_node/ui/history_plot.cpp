#include "render_node/ui/force_plot.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace palpate::render {
namespace {

const ImU32 hand_colour = IM_COL32(28, 98, 178, 255);
const ImU32 tissue_colour = IM_COL32(226, 96, 24, 255);
const ImU32 grid_colour = IM_COL32(205, 211, 219, 255);

struct Axes {
  ImVec2 corner, size;  // top left, extent [px]
  double top = 1;       // [N]
  ImVec2 at(double age, double newton) const {
    const double x = 1.0 - age / ForceHistory::span_s, y = 1.0 - newton / top;
    return {corner.x + size.x * static_cast<float>(x), corner.y + size.y * static_cast<float>(y)};
  }
};

std::string label(double newton) { return fmt::format("{:g}", newton); }

void draw_grid(ImDrawList& list, const Axes& axes) {
  const ImU32 text = ImGui::GetColorU32(ImGuiCol_TextDisabled);
  const float line = ImGui::GetFontSize();
  for (int i = 0; i <= 2; ++i) {
    const double newton = axes.top * i / 2;
    const ImVec2 left = axes.at(ForceHistory::span_s, newton);
    list.AddLine(left, axes.at(0, newton), grid_colour);
    const std::string words = label(newton);
    const float width = ImGui::CalcTextSize(words.c_str()).x;
    list.AddText({left.x - width - 0.4F * line, left.y - 0.55F * line}, text, words.c_str());
  }
  for (const double age : {10.0, 5.0, 0.0}) {
    const ImVec2 foot = axes.at(age, 0);
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

void draw_history(ImDrawList& list, const Axes& axes, const ForceHistory& history, ImU32 colour) {
  std::vector<ImVec2> line;
  for (const auto& point : history.points()) line.push_back(axes.at(point.age, point.newton));
  const float width = ImGui::GetFontSize() * 0.12F;
  list.AddPolyline(line.data(), static_cast<int>(line.size()), colour, ImDrawFlags_None, width);
  if (!line.empty()) list.AddCircleFilled(line.back(), 1.7F * width, colour);
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

void force_plot(const ToolView& tool, float height) {
  const float line = ImGui::GetFontSize();
  if (!tool.on_hand.empty()) {
    legend("on the hand", hand_colour);
    ImGui::SameLine(0, line);
  }
  if (!tool.on_tool.empty()) legend("by the tissue", tissue_colour);
  if (tool.on_tool.empty()) ImGui::NewLine();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float free = ImGui::GetContentRegionAvail().x;
  const float left = 2.4F * line;
  const Axes axes{{corner.x + left, corner.y + 0.6F * line},
                  {free - left - 0.3F * line, height - 2.2F * line},
                  axis_top(std::max(tool.on_hand.peak(), tool.on_tool.peak()))};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  draw_grid(list, axes);
  draw_history(list, axes, tool.on_tool, tissue_colour);
  draw_history(list, axes, tool.on_hand, hand_colour);
  list.AddText(corner, ImGui::GetColorU32(ImGuiCol_TextDisabled), "N");
  ImGui::Dummy({free, height});
}

}  // namespace palpate::render
