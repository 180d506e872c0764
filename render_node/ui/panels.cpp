#include "render_node/ui/panels.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "common/math/units.h"
#include "common/scene/body_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "render_node/ui/history_plot.h"
#include "render_node/ui/scene_tree.h"

namespace palpate::render {
namespace {

constexpr double per_milli = 1e3;
constexpr std::size_t few = 4;  // Why: so many rows leave room for the plots at 1280 x 720

// 1234567 as 1,234,567.
std::string grouped(std::uint64_t n) {
  std::string backwards;
  for (int digits = 0; n > 0 || digits == 0; n /= 10, ++digits) {
    if (digits > 0 && digits % 3 == 0) backwards += ',';
    backwards += static_cast<char>('0' + n % 10);
  }
  return {backwards.rbegin(), backwards.rend()};
}

// A line of the column: what on the left, how much on the right.
void row(const char* what, const std::string& how_much) {
  ImGui::TextDisabled("%s", what);
  const float width = ImGui::CalcTextSize(how_much.c_str()).x;
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - width);
  ImGui::TextUnformatted(how_much.c_str());
}

std::string moment_words(const Vec3& moment) {
  const auto tenths = [](double value) {
    return std::round(10 * per_milli * value) / 10 + 0.0;
  };  // no "-0.0"
  return fmt::format("{:.1f}  {:.1f}  {:.1f} mN m", tenths(moment.x()), tenths(moment.y()),
                     tenths(moment.z()));
}

const char* word_for(NodePhase phase) {
  static constexpr std::array<const char*, n_node_phases> words = {"loading", "ready", "running", "stopping",
                                                                   "failed"};
  const auto i = static_cast<std::size_t>(phase);
  return i < words.size() ? words[i] : "?";
}

/// How fast a node goes; of physics also its share of real time.
std::string pace(const NodeStatus& status) {
  if (status.node == NodeKind::physics)
    return fmt::format("{:.0f} Hz  x{:.2f}", status.rate_Hz, status.real_time_factor);
  return fmt::format("{:.{}f} Hz", status.rate_Hz, status.node == NodeKind::render ? 1 : 0);
}

void node_rows(const ViewModel& model) {
  struct Named {
    NodeKind kind;
    const char* name;
  };
  bool any = false;
  for (const auto& [kind, name] : {Named{NodeKind::physics, "physics"}, Named{NodeKind::haptic, "haptic"},
                                   Named{NodeKind::render, "render"}}) {
    const auto& status = model.node(kind);
    if (!status) continue;
    any = true;
    row(name, status->phase == NodePhase::running ? pace(*status) : std::string(word_for(status->phase)));
  }
  const auto& haptic = model.node(NodeKind::haptic);
  if (haptic && haptic->loop_age_ms_p50 > 0)
    row("loop age", fmt::format("{:.2f} ms", haptic->loop_age_ms_p50));
  if (haptic) row("late ticks", grouped(haptic->late));
  if (any) ImGui::Separator();
}

struct ActionButton {
  const char* words;
  Action action;
};

/// Buttons of one width, so many a line.
void buttons(const std::vector<ActionButton>& all, int a_line, PanelWishes& wishes) {
  const float gap = ImGui::GetStyle().ItemSpacing.x / 2;
  const float width =
      (ImGui::GetContentRegionAvail().x - static_cast<float>(a_line - 1) * gap) / static_cast<float>(a_line);
  int n = 0;
  for (const auto& [words, action] : all) {
    if (n++ % a_line != 0) ImGui::SameLine(0, gap);
    if (ImGui::Button(words, {width, 0})) wishes.actions.push_back(action);
    const Binding* binding = ImGui::IsItemHovered() ? binding_of(action) : nullptr;
    if (binding != nullptr) ImGui::SetTooltip("%s: %s", binding->keys, binding->does);
  }
}

/// A slider over the width of the column. @return it was let go after it had moved
bool slider(const char* name, double lo, double hi, const char* format, double& value) {
  auto shown = static_cast<float>(value);
  ImGui::SetNextItemWidth(-1);
  if (ImGui::SliderFloat(name, &shown, static_cast<float>(lo), static_cast<float>(hi), format))
    value = static_cast<double>(shown);
  return ImGui::IsItemDeactivatedAfterEdit();
}

/// Across which axis bodies are cut open, and where.
void section_rows(const ViewModel& model, const PanelFacts& facts, SectionControl& section,
                  PanelWishes& wishes) {
  static constexpr std::array<const char*, 3> names = {"x", "y", "z"};
  const auto words = [&] {
    return fmt::format("{} = {:.1f} mm", names[static_cast<std::size_t>(section.value()->axis)],
                       mm_from_m(section.value()->at));
  };
  if (!section.applies()) return;
  if (!facts.interactive) {
    if (section.value()) row("cut open at", words());
    return;
  }
  ImGui::TextDisabled("cut open");
  ImGui::SameLine();
  if (ImGui::RadioButton("no", !section.value())) section.close();
  for (int axis = 0; axis < 3; ++axis) {
    ImGui::SameLine();
    if (ImGui::RadioButton(names[static_cast<std::size_t>(axis)],
                           section.value() && section.value()->axis == axis))
      section.choose(axis, model.box());
  }
  if (!section.value() || model.box().isEmpty()) return;
  const int axis = section.value()->axis;
  const double before = mm_from_m(section.value()->at);
  double at = before;
  wishes.section_released = slider("##section", mm_from_m(model.box().min()[axis]),
                                   mm_from_m(model.box().max()[axis]), "%.1f mm", at);
  if (at != before) section.move_to(m_from_mm(at), model.box());
}

/// What lies inside of images, and how far one sees through what lies before it.
void inside_rows(const PanelFacts& facts, InsideControl& inside, PanelWishes& wishes) {
  if (!facts.interactive) {
    if (inside.value()) row("inside from intensity", fmt::format("{:.0f}", *inside.value()));
    return;
  }
  if (inside.applies()) {
    bool on = inside.value().has_value();
    if (ImGui::Checkbox("inside from intensity", &on)) inside.toggle();
    if (double from = inside.value().value_or(0); inside.value()) {
      wishes.inside_released = slider("##inside", inside.lo(), inside.hi(), "%.0f", from);
      inside.set(from);
    }
  }
  double opacity = inside.opacity();
  slider("##opacity", InsideControl::least_opacity, 1, "opacity %.2f", opacity);
  inside.set_opacity(opacity);
}

PanelWishes controls(const Scene& scene, const ViewModel& model, const PanelFacts& facts,
                     ThresholdControl& threshold, SectionControl& section, InsideControl& inside) {
  PanelWishes wishes;
  if (threshold.applies()) {
    if (facts.interactive) {
      double value = threshold.value();
      ImGui::TextDisabled("tissue from intensity");
      wishes.threshold_released = slider("##threshold", threshold.lo(), threshold.hi(), "%.0f", value);
      threshold.set(value);
    } else {
      row("tissue from intensity", fmt::format("{:.0f}", threshold.value()));
    }
  }
  section_rows(model, facts, section, wishes);
  inside_rows(facts, inside, wishes);
  if (facts.interactive) {
    std::vector<ActionButton> all{{facts.paused ? "Go on" : "Pause", Action::pause},
                                  {"Step", Action::hundredth_on},
                                  {"Help", Action::help},
                                  {"Reset", Action::reset},
                                  {"Picture", Action::picture},
                                  {"Fold", Action::fold}};
    if (std::ranges::any_of(scene.tools, cuts)) all.push_back({"Undo", Action::undo});
    buttons(all, 3, wishes);
  }
  if (facts.interactive || threshold.applies() || section.value() || inside.value()) ImGui::Separator();
  return wishes;
}

/// A part of the column that a person may fold away; in a picture without a hand it has no heading.
bool section(const char* heading, bool interactive, bool open) {
  if (!interactive) return true;
  return ImGui::CollapsingHeader(heading, open ? ImGuiTreeNodeFlags_DefaultOpen : ImGuiTreeNodeFlags_None);
}

/// What the plots of the first tool may take of the height that is left, so that what follows them stays in sight; legible at least.
float plot_height(const ViewModel& model, const PanelFacts& facts, float scale) {
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const float plots = shows_moments(model.tools().front()) ? 1.87F : 1.0F;
  float rows = facts.arrow_metres_per_newton > 0 ? 1.0F : 0.0F;
  for (std::size_t i = 1; i < model.tools().size(); ++i)
    rows += 1 + (model.tools()[i].on_hand.empty() ? 0.0F : 1.0F) + (model.tools()[i].answered ? 3.0F : 0.0F);
  const float legends = plots > 1 ? 2.0F : 1.0F;
  const float left =
      ImGui::GetContentRegionAvail().y - (rows + legends) * line - ImGui::GetStyle().ItemSpacing.y;
  return std::clamp(left / plots, 84 * scale, 150 * scale);
}

void tool_rows(const Scene& scene, const ViewModel& model, const PanelFacts& facts, float scale) {
  for (std::size_t i = 0; i < model.tools().size(); ++i) {
    const ToolView& tool = model.tools()[i];
    ImGui::TextUnformatted(scene.tools[i].name.c_str());
    if (!tool.on_hand.empty()) row("force on the hand", fmt::format("{:.2f} N", tool.on_hand.now()));
    if (tool.answered) {
      row("force by the tissue", fmt::format("{:.2f} N", tool.force.norm()));
      row("moment", moment_words(tool.moment));
      row("colliding masses", grouped(tool.n_contacts));
    }
    if (i > 0) continue;
    const float height = plot_height(model, facts, scale);
    force_plot(tool, height);
    moment_plot(tool, 0.87F * height);
  }
  if (!model.tools().empty() && facts.arrow_metres_per_newton > 0) {
    row("arrow: 1 N is", fmt::format("{:g} mm", mm_from_m(facts.arrow_metres_per_newton)));
  }
}

void view_rows(PanelWishes& wishes) {
  buttons({{"Front", Action::front},
           {"Side", Action::side},
           {"Top", Action::top},
           {"Tool", Action::at_tool},
           {"Fit", Action::fit},
           {"Home", Action::first_view},
           {"Wires", Action::wires}},
          4, wishes);
}

void warning_rows(const ViewModel& model) {
  for (const auto kind : {NodeKind::physics, NodeKind::haptic, NodeKind::render}) {
    const auto& status = model.node(kind);
    if (!status || status->note[0] == '\0') continue;
    ImGui::TextWrapped("%.*s", static_cast<int>(status->note.size()), status->note.data());
  }
}

}  // namespace

PanelWishes lay_out_panels(const Scene& scene, const ViewModel& model, const PanelFacts& facts,
                           const PanelControls& moved, float scale) {
  const ImVec2 picture = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize({panel_width_in(picture.x, scale), picture.y});
  ImGui::Begin("panels", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
  ImGui::TextWrapped("%s", scene.title.c_str());
  row("simulated time", fmt::format("{:.2f} s", facts.t));
  warning_rows(model);
  ImGui::Separator();
  PanelWishes wishes = controls(scene, model, facts, moved.threshold, moved.section, moved.inside);
  if (facts.pointer != nullptr)
    row("mouse", fmt::format("{} {}", facts.pointer->held() ? "holds" : "lets lie",
                             scene.tools[facts.pointer->tool()].name));
  if (facts.interactive && section("View", true, true)) view_rows(wishes);
  if (facts.interactive && section("Bodies and tools", true, scene.bodies.size() + scene.tools.size() <= few))
    lay_out_scene_tree(scene, moved.hidden);
  if (section("Nodes", facts.interactive, false)) {
    node_rows(model);
    row("facets visible",
        fmt::format("{} of {}", grouped(model.facets_visible()), grouped(model.facets_total())));
    ImGui::Separator();
  }
  tool_rows(scene, model, facts, scale);
  ImGui::End();
  return wishes;
}

float panel_width_in(float picture_width, float scale) {
  return std::min(panel_width * scale, 0.4F * picture_width);
}

PanelWishes lay_out_folded() {
  PanelWishes wishes;
  ImGui::SetNextWindowPos({0, 0});
  ImGui::Begin("folded", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoMove);
  if (ImGui::Button("Unfold (F2)")) wishes.actions.push_back(Action::fold);
  ImGui::End();
  return wishes;
}

}  // namespace palpate::render
