#include "render_node/ui/scene_tree.h"

#include <imgui.h>

#include <algorithm>
#include <string>

#include "common/scene/body_spec.h"
#include "common/scene/connection_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"

namespace palpate::render {
namespace {

constexpr std::size_t most_rows = 8;

/// An eye and a name on one line, both to be clicked on. @return clicked
bool eye_row(const std::string& name, bool seen) {
  const float height = ImGui::GetTextLineHeight(), half = 0.62F * height;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::PushID(name.c_str());
  const bool clicked = ImGui::InvisibleButton("eye", {ImGui::GetContentRegionAvail().x, height});
  const ImU32 ink =
      ImGui::GetColorU32(ImGui::IsItemHovered() || seen ? ImGuiCol_Text : ImGuiCol_TextDisabled);
  ImGui::PopID();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 middle = {at.x + half, at.y + height / 2};
  const ImVec2 left = {middle.x - half, middle.y}, right = {middle.x + half, middle.y};
  // Two lids; the pupil where it is seen, a stroke through it where not.
  for (const float lid : {-0.5F * height, 0.5F * height})
    list.AddBezierQuadratic(left, {middle.x, middle.y + 1.5F * lid}, right, ink, 1.4F);
  if (seen)
    list.AddCircleFilled(middle, 0.19F * height, ink);
  else
    list.AddLine({left.x, middle.y + 0.4F * height}, {right.x, middle.y - 0.4F * height}, ink, 1.4F);
  list.AddText({at.x + 2.9F * half, at.y}, ImGui::GetColorU32(seen ? ImGuiCol_Text : ImGuiCol_TextDisabled),
               name.c_str());
  return clicked;
}

/// @param first  what comes before these in `hidden`
template <class Specs>
void eye_rows(const Specs& specs, std::size_t first, std::vector<bool>& hidden) {
  hidden.resize(std::max(hidden.size(), first + specs.size()), false);
  for (std::size_t i = 0; i < specs.size(); ++i)
    if (eye_row(specs[i].name, !hidden[first + i])) hidden[first + i] = !hidden[first + i];
}

std::size_t n_rows(const Scene& scene) {
  return scene.bodies.size() + scene.connections.size() + scene.tools.size();
}

}  // namespace

void lay_out_scene_tree(const Scene& scene, Hidden& hidden) {
  const std::size_t rows = std::min(n_rows(scene), most_rows);
  const float height = static_cast<float>(rows) * ImGui::GetTextLineHeightWithSpacing();
  ImGui::BeginChild("bodies and tools", {0, height}, false, ImGuiWindowFlags_NoNav);
  ImGui::PushID("bodies");
  eye_rows(scene.bodies, 0, hidden.bodies);
  ImGui::PopID();
  ImGui::PushID("connections");
  eye_rows(scene.connections, scene.bodies.size(), hidden.bodies);
  ImGui::PopID();
  ImGui::PushID("tools");
  eye_rows(scene.tools, 0, hidden.tools);
  ImGui::PopID();
  ImGui::EndChild();
}

}  // namespace palpate::render
