#include "render_node/ui/imgui_context.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace palpate::render {
namespace {

constexpr float font_px = 17;
constexpr const char* font_file =
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";  // Debian: fonts-dejavu-core

void load_font(float px) {
  ImGuiIO& io = ImGui::GetIO();
  static const ImWchar letters[] = {0x20, 0xff, 0x2010, 0x2026, 0};  // Latin, dashes
  std::error_code none;
  if (std::filesystem::exists(font_file, none)) {
    io.Fonts->AddFontFromFileTTF(font_file, px, nullptr, letters);
    return;
  }
  ImFontConfig built_in;  // coarser, always there
  built_in.SizePixels = std::round(px);
  io.Fonts->AddFontDefault(&built_in);
}

void choose_colours() {
  ImGui::StyleColorsLight();
  ImGuiStyle& style = ImGui::GetStyle();
  style.Colors[ImGuiCol_WindowBg] = ImVec4(1.0F, 1.0F, 1.0F, 0.92F);
  style.Colors[ImGuiCol_FrameBg] = ImVec4(0.88F, 0.90F, 0.93F, 1.0F);
  style.Colors[ImGuiCol_Text] = ImVec4(0.10F, 0.13F, 0.17F, 1.0F);
  style.Colors[ImGuiCol_TextDisabled] = ImVec4(0.40F, 0.45F, 0.51F, 1.0F);
  style.Colors[ImGuiCol_Separator] = ImVec4(0.80F, 0.83F, 0.87F, 1.0F);
  style.Colors[ImGuiCol_Border] = ImVec4(0.80F, 0.83F, 0.87F, 1.0F);
  style.WindowRounding = 0;
  style.FrameRounding = 4;
  style.GrabRounding = 4;
  style.WindowBorderSize = 0;
  style.WindowPadding = ImVec2(16, 14);
  style.ItemSpacing = ImVec2(8, 6);
}

}  // namespace

ImguiContext::ImguiContext(int height)
    : context_(ImGui::CreateContext()),
      height_(height),
      scale_(std::max(0.5F, static_cast<float>(height) / 720.0F)) {
  make_current();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // nothing is remembered between runs
  io.LogFilename = nullptr;
  choose_colours();
  ImGui::GetStyle().ScaleAllSizes(scale_);
  load_font(font_px * scale_);
}

ImguiContext::~ImguiContext() { ImGui::DestroyContext(context_); }

float ImguiContext::fit(int height) const {
  const float ratio = std::clamp(static_cast<float>(height) / static_cast<float>(height_), 0.5F, 1.0F);
  ImGui::GetIO().FontGlobalScale = ratio;
  return ratio * scale_;
}

void ImguiContext::make_current() const { ImGui::SetCurrentContext(context_); }

}  // namespace palpate::render
