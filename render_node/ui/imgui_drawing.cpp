#include "render_node/ui/imgui_drawing.h"

#include <epoxy/gl.h>
#include <imgui.h>

#include <cstddef>
#include <cstdint>

namespace palpate::render {
namespace {

const char* const vertex_source = R"(
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 texel;
layout(location = 2) in vec4 colour;
uniform vec2 size;
out vec2 place;
out vec4 tint;
void main() {
  place = texel;
  tint = colour;
  gl_Position = vec4(2.0 * position.x / size.x - 1.0, 1.0 - 2.0 * position.y / size.y, 0.0, 1.0);
}
)";
const char* const fragment_source = R"(
in vec2 place;
in vec4 tint;
uniform sampler2D font;
out vec4 pixel;
void main() { pixel = vec4(tint.rgb, tint.a * texture(font, place).r); }
)";

const void* offset_of(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

}  // namespace

ImguiDrawing::ImguiDrawing() : program_(vertex_source, fragment_source) {
  unsigned char* texels = nullptr;
  int width = 0, height = 0;
  ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&texels, &width, &height);
  glGenTextures(1, &font_);
  glBindTexture(GL_TEXTURE_2D, font_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, width, height, 0, GL_RED, GL_UNSIGNED_BYTE, texels);
  array_.bind();
  vertices_.bind();
  constexpr GLsizei stride = sizeof(ImDrawVert);
  glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, stride, offset_of(offsetof(ImDrawVert, pos)));
  glVertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, stride, offset_of(offsetof(ImDrawVert, uv)));
  glVertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, offset_of(offsetof(ImDrawVert, col)));
  for (GLuint place = 0; place < 3; ++place) glEnableVertexAttribArray(place);
}

ImguiDrawing::~ImguiDrawing() { glDeleteTextures(1, &font_); }

void ImguiDrawing::begin(int width, int height) {
  glViewport(0, 0, width, height);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_SCISSOR_TEST);
  program_.use();
  program_.set("size", Eigen::Vector2f(static_cast<float>(width), static_cast<float>(height)));
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, font_);
  array_.bind();
}

void ImguiDrawing::draw() {
  const ImDrawData* data = ImGui::GetDrawData();
  const auto height = static_cast<int>(data->DisplaySize.y);
  begin(static_cast<int>(data->DisplaySize.x), height);
  for (int l = 0; l < data->CmdListsCount; ++l) {
    const ImDrawList& list = *data->CmdLists[l];
    vertices_.upload(
        std::span<const ImDrawVert>(list.VtxBuffer.Data, static_cast<std::size_t>(list.VtxBuffer.Size)));
    indices_.upload(
        std::span<const ImDrawIdx>(list.IdxBuffer.Data, static_cast<std::size_t>(list.IdxBuffer.Size)));
    for (const ImDrawCmd& command : list.CmdBuffer) {
      const ImVec4& clip = command.ClipRect;  // left, top, right, bottom
      if (clip.z <= clip.x || clip.w <= clip.y) continue;
      glScissor(static_cast<GLint>(clip.x), height - static_cast<GLint>(clip.w),
                static_cast<GLsizei>(clip.z - clip.x), static_cast<GLsizei>(clip.w - clip.y));
      glDrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount),
                               sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT,
                               offset_of(command.IdxOffset * sizeof(ImDrawIdx)),
                               static_cast<GLint>(command.VtxOffset));
    }
  }
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
}

}  // namespace palpate::render
