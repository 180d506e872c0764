#pragma once
// A Dear ImGui context in this project's looks, with a font that is legible at the picture's height.

struct ImGuiContext;

namespace palpate::render {

class ImguiContext {
 public:
  /// @param height  of the picture [px]; text is 17 px at 720
  explicit ImguiContext(int height);
  ~ImguiContext();
  ImguiContext(const ImguiContext&) = delete;
  ImguiContext& operator=(const ImguiContext&) = delete;

  void make_current() const;
  float scale() const noexcept { return scale_; }  // of all lengths, 1 at 720 px

 private:
  ImGuiContext* context_;
  float scale_;
};

}  // namespace palpate::render
