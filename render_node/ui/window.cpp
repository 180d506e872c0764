#include "render_node/ui/window.h"

#include <epoxy/gl.h>
// GLFW after epoxy, which brings the OpenGL declarations.
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "common/error/error.h"
#include "render_node/gl/egl_context.h"
#include "render_node/gl/framebuffer.h"
#include "render_node/ui/stage.h"

namespace palpate::render {
namespace {

constexpr int samples_per_pixel = 4;

[[noreturn]] void complain() {
  const char* words = nullptr;
  glfwGetError(&words);
  throw InputError(std::string("cannot open a window (") + (words == nullptr ? "no reason given" : words) +
                   "); use --headless, or a display with OpenGL 3.3");
}

bool variable_set(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0';
}

}  // namespace

bool display_present() { return variable_set("DISPLAY") || variable_set("WAYLAND_DISPLAY"); }

struct Window::Glfw {
  explicit Glfw(const Scene& scene) {
    if (!glfwInit()) complain();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_SAMPLES, samples_per_pixel);
    const std::string title = scene.title.empty() ? "palpate" : scene.title + " \xe2\x80\x93 palpate";
    window =
        glfwCreateWindow(scene.render.size_px[0], scene.render.size_px[1], title.c_str(), nullptr, nullptr);
    if (window == nullptr) {
      glfwTerminate();
      complain();
    }
    glfwMakeContextCurrent(window);
    glfwSwapInterval(1);
  }
  ~Glfw() {
    glfwDestroyWindow(window);
    glfwTerminate();
  }
  Glfw(const Glfw&) = delete;
  Glfw& operator=(const Glfw&) = delete;
  GLFWwindow* window = nullptr;
};

Window::Window(const Scene& scene, ViewModel& model, const std::vector<std::uint32_t>& pointed)
    : glfw_(std::make_unique<Glfw>(scene)),
      stage_(std::make_unique<Stage>(scene, model, scene.render.size_px[1])),
      scene_(scene),
      model_(model),
      pointed_(pointed),
      last_draw_(glfwGetTime()) {
  stage_->make_current();
  ImGui_ImplGlfw_InitForOpenGL(glfw_->window, true);
}

Window::~Window() {
  stage_->make_current();
  ImGui_ImplGlfw_Shutdown();
  stage_.reset();
}

PanelWishes Window::draw(const PanelFacts& facts, Image* seen) {
  glfwPollEvents();
  stage_->make_current();
  int width = 0, height = 0;
  glfwGetFramebufferSize(glfw_->window, &width, &height);
  if (width == 0 || height == 0) return {};  // minimised
  const double now = glfwGetTime();
  ImGui_ImplGlfw_NewFrame();
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  const double seconds = std::max(now - last_draw_, 1e-3);
  PanelFacts shown = facts;
  shown.pointer = pointers_.empty() ? nullptr : &pointers_[led_];
  const auto wheel = static_cast<double>(ImGui::GetIO().MouseWheel);  // the end of the frame forgets it
  const auto wishes = stage_->draw(shown, width, height, static_cast<float>(seconds));
  last_draw_ = now;
  lay_out_pointers();
  follow_hand(wheel, seconds);
  if (seen != nullptr) *seen = read_pixels(width, height);
  glfwSwapBuffers(glfw_->window);
  return wishes;
}

/// A tool that is a body lies where its body is; a point lies before all bodies, in the middle of the view.
void Window::lay_out_pointers() {
  if (pointed_.empty() || !pointers_.empty() || !model_.anything_to_see()) return;
  const Camera& camera = stage_->camera();
  const auto box = model_.box();
  const Vec3 before = box.center() + 0.5 * box.diagonal().norm() * camera.axes().row(2).transpose();
  for (const std::uint32_t tool : pointed_) {
    const auto body = std::find_if(scene_.bodies.begin(), scene_.bodies.end(), [&](const BodySpec& spec) {
      return spec.name == scene_.tools[tool].body;
    });
    pointers_.emplace_back(tool, body == scene_.bodies.end() ? before : body->at);
  }
}

void Window::follow_hand(double wheel, double seconds) {
  const ImGuiIO& io = ImGui::GetIO();
  Camera& camera = stage_->camera();
  const bool moved = io.MouseDelta.x != 0 || io.MouseDelta.y != 0;
  const auto dx = static_cast<double>(io.MouseDelta.x), dy = static_cast<double>(io.MouseDelta.y);
  const bool holds = !pointers_.empty() && pointers_[led_].held();
  if (!io.WantCaptureMouse) {
    if (moved && io.MouseDown[0]) camera.rotate(dx, dy);
    if (moved && io.MouseDown[1]) camera.pan(dx, dy);
    if (wheel != 0 && !holds) camera.zoom(wheel);
  }
  if (!pointers_.empty()) lead_tool(wheel, seconds);
  if (io.WantTextInput) return;
  if (ImGui::IsKeyPressed(GLFW_KEY_W, false)) stage_->options().wire = !stage_->options().wire;
  if (ImGui::IsKeyPressed(GLFW_KEY_R, false)) camera.reset();
  if (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) leave_ = true;
}

void Window::lead_tool(double wheel, double seconds) {
  const ImGuiIO& io = ImGui::GetIO();
  if (!io.WantTextInput && ImGui::IsKeyPressed(GLFW_KEY_TAB, false)) {
    pointers_[led_].let_go();
    led_ = (led_ + 1) % pointers_.size();
  }
  const auto key = [&](int code) { return !io.WantTextInput && ImGui::IsKeyDown(code) ? 1.0 : 0.0; };
  PointerInput input;
  input.cursor = {static_cast<double>(io.MousePos.x), static_cast<double>(io.MousePos.y)};
  const bool in_window = ImGui::IsMousePosValid() && !io.WantCaptureMouse;
  input.follows = in_window && !io.MouseDown[0] && !io.MouseDown[1];
  input.wheel = in_window ? wheel : 0.0;
  input.fine = io.KeyShift;
  input.turn = {key(GLFW_KEY_DOWN) - key(GLFW_KEY_UP), key(GLFW_KEY_RIGHT) - key(GLFW_KEY_LEFT),
                key(GLFW_KEY_PAGE_UP) - key(GLFW_KEY_PAGE_DOWN)};
  input.toggle = !io.WantTextInput && ImGui::IsKeyPressed(GLFW_KEY_T, false);
  input.buttons = key(GLFW_KEY_SPACE) > 0 ? 1u : 0u;
  pointers_[led_].follow(input, stage_->camera(), seconds);
}

bool Window::closing() const { return leave_ || glfwWindowShouldClose(glfw_->window) != 0; }
bool Window::software() const { return software_gl(); }
ThresholdControl& Window::threshold() { return stage_->threshold(); }

}  // namespace palpate::render
