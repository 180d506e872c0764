#include "render_node/ui/window.h"

#include <epoxy/gl.h>
// GLFW after epoxy, which brings the OpenGL declarations.
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <algorithm>
#include <cstdlib>
#include <numbers>
#include <string>

#include "common/error/error.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "render_node/gl/egl_context.h"
#include "render_node/gl/framebuffer.h"
#include "render_node/ui/stage.h"

namespace palpate::render {
namespace {

/// Four smooth edges; where the processor draws, and has others to serve, that doubles the cost of a picture.
int samples_per_pixel() { return software_gl() && few_cores() ? 0 : 4; }

[[noreturn]] void complain() {
  const char* words = nullptr;
  glfwGetError(&words);
  throw InputError(std::string("cannot open a window (") + (words == nullptr ? "no reason given" : words) +
                   "); use --headless, or a display with OpenGL 3.3");
}

constexpr double words_s = 6;  // how long say() is shown [s]

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
      stage_(std::make_unique<Stage>(scene, model, scene.render->size_px[1], samples_per_pixel())),
      scene_(scene),
      model_(model),
      leading_(scene, model, pointed),
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
  glfwSetCharCallback(glfw_->window, [](GLFWwindow* window, unsigned c) { events(window).character(c); });
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
  if (width == 0 || height == 0) {  // minimised
    PanelWishes none;
    none.paused = facts.paused;
    return none;
  }
  const double now = glfwGetTime();
  ImGui_ImplGlfw_NewFrame();
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  const double seconds = std::max(now - last_draw_, 1e-3);
  PanelFacts shown = facts;
  shown.pointer = leading_.led();
  shown.help = help_;
  shown.folded = folded_;
  if (now < words_until_) shown.words = words_;
  const auto wheel = static_cast<double>(ImGui::GetIO().MouseWheel);  // the end of the frame forgets it
  auto wishes = stage_->draw(shown, width, height, static_cast<float>(seconds));
  last_draw_ = now;
  const CursorNow cursor = cursor_now(wheel);
  leading_.lay_out(stage_->camera());
  move_camera(cursor);
  leading_.lead(events_, cursor, stage_->camera(), seen_bodies(), seconds);
  wishes.paused = facts.paused;
  for (const Action action : wishes.actions) perform(action, wishes);
  if (!cursor.typing) perform_keys(wishes);
  events_.forget();
  if (wishes.picture) PixelReader().read(width, height, *wishes.picture);
  if (seen != nullptr) PixelReader().read(width, height, *seen);
  glfwSwapBuffers(glfw_->window);
  return wishes;
}

void Window::say(const std::string& words) {
  words_ = words;
  words_until_ = glfwGetTime() + words_s;
}

CursorNow Window::cursor_now(double wheel) const {
  const ImGuiIO& io = ImGui::GetIO();
  CursorNow cursor;
  cursor.pixel = {static_cast<double>(io.MousePos.x), static_cast<double>(io.MousePos.y)};
  cursor.in_picture = ImGui::IsMousePosValid() && !io.WantCaptureMouse && !help_;
  cursor.drags = io.MouseDown[0] || io.MouseDown[1];
  cursor.wheel = wheel;
  cursor.fine = io.KeyShift;
  cursor.typing = io.WantTextInput;
  return cursor;
}

void Window::move_camera(const CursorNow& cursor) {
  if (ImGui::GetIO().WantCaptureMouse || help_) return;
  Camera& camera = stage_->camera();
  const Eigen::Vector2d left = events_.drag(0), right = events_.drag(1);
  if (!left.isZero()) camera.rotate(left.x(), left.y());
  if (!right.isZero()) camera.pan(right.x(), right.y());
  if (cursor.wheel != 0 && !leading_.holds()) camera.zoom(cursor.wheel);
}

/// Every tap counts: what switches to and fro does so as often.
void Window::perform_keys(PanelWishes& wishes) {
  for (int i = 1; i < n_actions; ++i)
    for (int n = presses(events_, static_cast<Action>(i)); n > 0; --n)
      perform(static_cast<Action>(i), wishes);
}

void Window::perform(Action action, PanelWishes& wishes) {
  Camera& camera = stage_->camera();
  constexpr double quarter = std::numbers::pi / 2;
  switch (action) {
    case Action::help:
      help_ = !help_;
      break;
    case Action::fold:
      folded_ = !folded_;
      break;
    case Action::pause:
      wishes.paused = !wishes.paused;
      break;
    case Action::frame_on:
      ++wishes.frames_on;
      break;
    case Action::hundredth_on:
      ++wishes.hundredths_on;
      break;
    case Action::reset:
      wishes.reset = true;
      break;
    case Action::undo:
      wishes.undo = true;
      break;
    case Action::picture:
      wishes.picture.emplace();
      break;
    case Action::close:
      leave_ = leave_ || !help_;
      help_ = false;
      break;
    case Action::front:
      camera.look_from(0, 0);
      break;
    case Action::side:
      camera.look_from(quarter, 0);
      break;
    case Action::top:
      camera.look_from(0, quarter);
      break;
    case Action::at_tool:
      look_at_tool();
      break;
    case Action::fit:
      camera.fit_all();
      break;
    case Action::first_view:
      camera.reset();
      break;
    case Action::wires:
      stage_->options().wire = !stage_->options().wire;
      break;
    case Action::ways:
      stage_->options().colour = next(stage_->options().colour);
      break;
    case Action::section:
      stage_->section().next(model_.box());
      break;
    case Action::inside:
      stage_->inside().toggle();
      break;
    case Action::section_on:
      stage_->section().move(1, model_.box());
      break;
    case Action::section_back:
      stage_->section().move(-1, model_.box());
      break;
    default:
      break;  // about the tool that the mouse leads
  }
}

SeenBodies Window::seen_bodies() const {
  SeenBodies seen{stage_->options().hidden, {}};
  if (const auto& section = stage_->section().value())
    seen.cut = section_cut(*section, stage_->camera().eye());
  return seen;
}

/// At the tool that the mouse leads, or else the first that is known.
void Window::look_at_tool() {
  const double least = 0.15 * model_.box().diagonal().norm();
  for (std::size_t i = 0; i < model_.tools().size(); ++i) {
    const ToolView& tool = model_.tools()[i];
    if (!tool.tip || (leading_.led() != nullptr && leading_.led()->tool() != i)) continue;
    stage_->camera().look_at(tool.proxy, std::max(least, 12 * scene_.tools[i].radius));
    return;
  }
}

bool Window::closing() const { return leave_ || glfwWindowShouldClose(glfw_->window) != 0; }
bool Window::software() const { return software_gl(); }
ThresholdControl& Window::threshold() { return stage_->threshold(); }
ColourKind& Window::colour() { return stage_->options().colour; }
SectionControl& Window::section() { return stage_->section(); }
InsideControl& Window::inside() { return stage_->inside(); }

}  // namespace palpate::render
