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
#include "common/scene/body_spec.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "render_node/gl/egl_context.h"
#include "render_node/gl/framebuffer.h"
#include "render_node/ui/stage.h"
#include "render_node/view/surface_under.h"

namespace palpate::render {
namespace {

constexpr int samples_per_pixel = 4;

[[noreturn]] void complain() {
  const char* words = nullptr;
  glfwGetError(&words);
  throw InputError(std::string("cannot open a window (") + (words == nullptr ? "no reason given" : words) +
                   "); use --headless, or a display with OpenGL 3.3");
}

/// How far before a surface a tool starts, besides what the surface's own steps ask for [m]. A point has no extent to the hand.
double clearance(const ToolSpec& tool) { return tool.shape == ToolShape::stick ? tool.radius : 0.0; }

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
        glfwCreateWindow(scene.render->size_px[0], scene.render->size_px[1], title.c_str(), nullptr, nullptr);
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
      stage_(std::make_unique<Stage>(scene, model, scene.render->size_px[1])),
      scene_(scene),
      model_(model),
      pointed_(pointed),
      last_draw_(glfwGetTime()) {
  stage_->make_current();
  hear();
  ImGui_ImplGlfw_InitForOpenGL(glfw_->window, true);  // passes events on to who heard them before
}

/// Why events: Dear ImGui 1.86 asks what is down when a picture is drawn, so that a tap between two pictures does not exist for it.
void Window::hear() {
  glfwSetWindowUserPointer(glfw_->window, &events_);
  static constexpr auto events = [](GLFWwindow* window) -> HandEvents& {
    return *static_cast<HandEvents*>(glfwGetWindowUserPointer(window));
  };
  glfwSetKeyCallback(glfw_->window, [](GLFWwindow* window, int key, int, int action, int) {
    if (action != GLFW_REPEAT) events(window).key(key, action == GLFW_PRESS);
  });
  glfwSetMouseButtonCallback(glfw_->window, [](GLFWwindow* window, int button, int action, int) {
    events(window).button(button, action == GLFW_PRESS);
  });
  glfwSetCursorPosCallback(glfw_->window,
                           [](GLFWwindow* window, double x, double y) { events(window).cursor(x, y); });
  glfwSetWindowFocusCallback(glfw_->window, [](GLFWwindow* window, int focused) {
    if (focused == 0) events(window).leave();
  });
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
  events_.forget();
  if (seen != nullptr) *seen = read_pixels(width, height);
  glfwSwapBuffers(glfw_->window);
  return wishes;
}

/// A tool that is a body lies where its body is; another before the surface in the middle of the view, or before all bodies.
void Window::lay_out_pointers() {
  if (pointed_.empty() || !pointers_.empty() || !model_.anything_to_see()) return;
  const Camera& camera = stage_->camera();
  const auto box = model_.box();
  const Vec3 before = box.center() + 0.5 * box.diagonal().norm() * camera.axes().row(2).transpose();
  const auto middle = camera.project(camera.target());
  for (const std::uint32_t tool : pointed_) {
    const auto surface = middle
                             ? surface_under(model_.bodies(), camera, *middle, clearance(scene_.tools[tool]))
                             : std::nullopt;
    const auto body = std::find_if(scene_.bodies.begin(), scene_.bodies.end(), [&](const BodySpec& spec) {
      return spec.name == scene_.tools[tool].body;
    });
    pointers_.emplace_back(tool, body == scene_.bodies.end() ? surface.value_or(before) : body->at);
  }
}

/// A tool that is a body starts where it lies: to jump would tear what it is in.
std::optional<Vec3> Window::surface_under_cursor(std::uint32_t tool) const {
  const ImGuiIO& io = ImGui::GetIO();
  if (scene_.tools[tool].shape == ToolShape::body || !ImGui::IsMousePosValid() || io.WantCaptureMouse)
    return std::nullopt;
  return surface_under(model_.bodies(), stage_->camera(),
                       {static_cast<double>(io.MousePos.x), static_cast<double>(io.MousePos.y)},
                       clearance(scene_.tools[tool]));
}

void Window::follow_hand(double wheel, double seconds) {
  const ImGuiIO& io = ImGui::GetIO();
  Camera& camera = stage_->camera();
  const Eigen::Vector2d left = events_.drag(0), right = events_.drag(1);
  const bool holds = !pointers_.empty() && pointers_[led_].held();
  if (!io.WantCaptureMouse) {
    if (!left.isZero()) camera.rotate(left.x(), left.y());
    if (!right.isZero()) camera.pan(right.x(), right.y());
    if (wheel != 0 && !holds) camera.zoom(wheel);
  }
  if (!pointers_.empty()) lead_tool(wheel, seconds);
  if (io.WantTextInput) return;
  if (events_.presses(GLFW_KEY_W) % 2 == 1) stage_->options().wire = !stage_->options().wire;
  if (events_.presses(GLFW_KEY_R) > 0) camera.reset();
  if (events_.presses(GLFW_KEY_ESCAPE) > 0) leave_ = true;
}

void Window::lead_tool(double wheel, double seconds) {
  const ImGuiIO& io = ImGui::GetIO();
  for (int n = io.WantTextInput ? 0 : events_.presses(GLFW_KEY_TAB); n > 0; --n) {
    pointers_[led_].let_go();
    led_ = (led_ + 1) % pointers_.size();
  }
  const auto key = [&](int code) { return io.WantTextInput ? 0.0 : events_.held(code, seconds) / seconds; };
  PointerInput input;
  input.cursor = {static_cast<double>(io.MousePos.x), static_cast<double>(io.MousePos.y)};
  const bool in_window = ImGui::IsMousePosValid() && !io.WantCaptureMouse;
  input.follows = in_window && !io.MouseDown[0] && !io.MouseDown[1];
  input.wheel = in_window ? wheel : 0.0;
  input.fine = io.KeyShift;
  input.turn = {key(GLFW_KEY_DOWN) - key(GLFW_KEY_UP), key(GLFW_KEY_RIGHT) - key(GLFW_KEY_LEFT),
                key(GLFW_KEY_PAGE_UP) - key(GLFW_KEY_PAGE_DOWN)};
  input.toggle = !io.WantTextInput && events_.presses(GLFW_KEY_T) % 2 == 1;
  if (input.toggle && !pointers_[led_].held()) input.surface = surface_under_cursor(pointers_[led_].tool());
  input.buttons = !io.WantTextInput && events_.down(GLFW_KEY_SPACE) ? 1u : 0u;
  pointers_[led_].follow(input, stage_->camera(), seconds);
}

bool Window::closing() const { return leave_ || glfwWindowShouldClose(glfw_->window) != 0; }
bool Window::software() const { return software_gl(); }
ThresholdControl& Window::threshold() { return stage_->threshold(); }

}  // namespace palpate::render
