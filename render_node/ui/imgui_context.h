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
  /// Text follows a window that is made lower than it began, down to half. @return of all lengths, 1 at 720 px
  float fit(int height) const;

 private:
  ImGuiContext* context_;
  int height_;
  float scale_;  // of the font
};

}  // namespace palpate::render
