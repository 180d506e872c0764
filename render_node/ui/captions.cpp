#include "render_node/ui/captions.h"

#include <imgui.h>

#include <algorithm>

namespace palpate::render {
namespace {

constexpr ImGuiWindowFlags quiet = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                                   ImGuiWindowFlags_NoFocusOnAppearing;

/// Lines in a box of their own. @param y  of its middle (or upper edge: pivot 0), of the picture's height
void box_of_lines(const char* name, const std::vector<std::string>& lines, float left, float y, float pivot) {
  const ImVec2 picture = ImGui::GetIO().DisplaySize;
  const float free = picture.x - left;
  const float pad = ImGui::GetStyle().WindowPadding.x;
  float widest = 0;
  for (const auto& line : lines) widest = std::max(widest, ImGui::CalcTextSize(line.c_str()).x);
  const float width = std::min(widest + 2 * pad, 0.9F * free);
  ImGui::SetNextWindowPos({left + 0.5F * free, y * picture.y}, ImGuiCond_Always, {0.5F, pivot});
  ImGui::SetNextWindowSize({width, 0});  // as high as its words
  ImGui::Begin(name, nullptr, quiet);
  for (const auto& line : lines) ImGui::TextWrapped("%s", line.c_str());
  ImGui::End();
}

}  // namespace

void lay_out_hindrances(const std::vector<std::string>& lines, float left) {
  if (!lines.empty()) box_of_lines("hindrances", lines, left, 0.5F, 0.5F);
}

void lay_out_words(const std::string& words, float left) {
  if (!words.empty()) box_of_lines("words", {words}, left, 0.02F, 0);
}

}  // namespace palpate::render
