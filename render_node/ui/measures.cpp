#include "render_node/ui/measures.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>

#include "render_node/view/scale_bar.h"

namespace palpate::render {
namespace {

constexpr ImU32 ink = IM_COL32(26, 33, 43, 255);
constexpr std::array<ImU32, 3> world_axis_colours = {IM_COL32(176, 42, 36, 255), IM_COL32(32, 120, 52, 255),
                                                     IM_COL32(38, 76, 168, 255)};

void draw_scale_bar(const Camera& camera, float left, float scale) {
  const ImVec2 picture = ImGui::GetIO().DisplaySize;
  const float most = std::min(180 * scale, 0.4F * (picture.x - left));
  if (most < 1) return;
  const ScaleBar bar = scale_bar(camera, static_cast<double>(most));
  const ImVec2 words = ImGui::CalcTextSize(bar.words.c_str());
  const auto length = static_cast<float>(bar.px);
  const float right = picture.x - 20 * scale, y = picture.y - 20 * scale, tick = 5 * scale;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddLine({right - length, y}, {right, y}, ink, 2 * scale);
  for (const float x : {right - length, right}) list.AddLine({x, y - tick}, {x, y + tick}, ink, 2 * scale);
  list.AddText({right - (length + words.x) / 2, y - tick - words.y}, ink, bar.words.c_str());
}

void draw_axes(const Camera& camera, float left, float scale) {
  const ImVec2 picture = ImGui::GetIO().DisplaySize;
  const float length = 34 * scale;
  const ImVec2 root = {left + 58 * scale, picture.y - 58 * scale};
  const Eigen::Matrix3f axes =
      camera.axes().cast<float>();  // columns: the world's axes, as the camera sees them
  std::array<int, 3> order = {0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return axes(2, a) < axes(2, b); });  // far ones first
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  for (const int axis : order) {
    if (axes.col(axis).head<2>().norm() < 0.25F) continue;  // it points at the viewer, or away
    const ImU32 colour = world_axis_colours[static_cast<std::size_t>(axis)];
    const ImVec2 along = {length * axes(0, axis), -length * axes(1, axis)};
    list.AddLine(root, {root.x + along.x, root.y + along.y}, colour, 2.5F * scale);
    static constexpr std::array<const char*, 3> names = {"x", "y", "z"};
    const char* name = names[static_cast<std::size_t>(axis)];
    const ImVec2 size = ImGui::CalcTextSize(name);
    list.AddText({root.x + 1.32F * along.x - size.x / 2, root.y + 1.32F * along.y - size.y / 2}, colour,
                 name);
  }
}

}  // namespace

void lay_out_legend(const ColourScale& colours, float scale) {
  const ImVec2 picture = ImGui::GetIO().DisplaySize;
  const float width = 150 * scale, height = 10 * scale;
  const ImVec2 low = {picture.x - 20 * scale - width, picture.y - 66 * scale};
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  constexpr int steps = 4;
  const auto colour = [](int n) {
    const auto& c = ColourScale::colours[static_cast<std::size_t>(n)];
    return IM_COL32(c[0], c[1], c[2], 255);
  };
  for (int n = 0; n < steps; ++n) {
    const float left = low.x + width * static_cast<float>(n) / steps, right = left + width / steps;
    list.AddRectFilledMultiColor({left, low.y}, {right, low.y + height}, colour(n), colour(n + 1),
                                 colour(n + 1), colour(n));
  }
  const std::string most = colours.words();
  const float line = ImGui::GetTextLineHeight();
  list.AddText({low.x, low.y - line - 2 * scale}, ink, colours.least_words());
  list.AddText({low.x + width - ImGui::CalcTextSize(most.c_str()).x, low.y - line - 2 * scale}, ink,
               most.c_str());
  list.AddText({low.x, low.y - 2 * line - 2 * scale}, ink, colours.heading());
}

void lay_out_measures(const Camera& camera, float left, float scale) {
  draw_scale_bar(camera, left, scale);
  draw_axes(camera, left, scale);
}

}  // namespace palpate::render
