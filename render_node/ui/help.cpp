#include "render_node/ui/help.h"

#include <imgui.h>

#include <algorithm>

#include "render_node/ui/bindings.h"

namespace palpate::render {
namespace {

void part_rows(Part part, float key_width) {
  ImGui::Spacing();
  ImGui::TextUnformatted(heading_of(part));
  ImGui::Separator();
  for (const Binding& binding : bindings()) {
    if (binding.part != part) continue;
    ImGui::TextUnformatted(binding.keys);
    ImGui::SameLine(key_width);
    ImGui::TextDisabled("%s", binding.does);
  }
}

/// Of the widest name of a key, and of a whole row.
struct Widths {
  float key = 0, row = 0;
};
Widths measure() {
  Widths w;
  for (const Binding& binding : bindings()) w.key = std::max(w.key, ImGui::CalcTextSize(binding.keys).x);
  w.key += 3 * ImGui::GetStyle().WindowPadding.x;
  for (const Binding& binding : bindings())
    w.row = std::max(w.row, w.key + ImGui::CalcTextSize(binding.does).x);
  return w;
}

}  // namespace

bool lay_out_help(bool pointed, float scale) {
  const ImVec2 picture = ImGui::GetIO().DisplaySize;
  const Widths widths = measure();
  const ImGuiStyle& style = ImGui::GetStyle();
  const float rows = static_cast<float>(bindings().size()) + 6;  // with headings and the button
  const float wish_x = widths.row + 2 * style.WindowPadding.x + style.ScrollbarSize;
  const float wish_y = rows * ImGui::GetTextLineHeightWithSpacing() + 60 * scale;
  ImGui::SetNextWindowPos({0.5F * picture.x, 0.5F * picture.y}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({std::min(wish_x, 0.94F * picture.x), std::min(wish_y, 0.94F * picture.y)});
  ImGui::SetNextWindowFocus();  // over the column
  ImGui::Begin("help", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav);
  if (pointed) part_rows(Part::tool, widths.key);
  part_rows(Part::view, widths.key);
  part_rows(Part::window, widths.key);
  ImGui::Spacing();
  const bool closed = ImGui::Button("Close");
  ImGui::End();
  return closed;
}

}  // namespace palpate::render
