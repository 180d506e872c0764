#pragma once
// Draws what Dear ImGui laid out, with the same OpenGL 3.3 as everything else.
// Why: ImGui's own backend opens libGL by itself, which need not be there when EGL is.

#include "render_node/gl/buffer.h"
#include "render_node/gl/program.h"

namespace palpate::render {

class ImguiDrawing {
 public:
  /// Uploads the fonts of the current ImGui context. Needs a current OpenGL context, here and later.
  ImguiDrawing();
  ~ImguiDrawing();
  ImguiDrawing(const ImguiDrawing&) = delete;
  ImguiDrawing& operator=(const ImguiDrawing&) = delete;

  /// Draws ImGui::GetDrawData() over what is there.
  void draw();

 private:
  void begin(int width, int height);
  Program program_;
  VertexArray array_;
  Buffer vertices_{Buffer::Kind::vertices};
  Buffer indices_{Buffer::Kind::indices};
  unsigned font_ = 0;
};

}  // namespace palpate::render
