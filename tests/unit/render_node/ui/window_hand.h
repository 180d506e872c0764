#pragma once
// A hand for the window under test: X events to the window of this process, as a server would send them.

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/keysym.h>

#include <cstring>
#include <string>

namespace palpate::render::test {

class WindowHand {
 public:
  /// @param title  how the window's title begins
  explicit WindowHand(const std::string& title) : display_(XOpenDisplay(nullptr)) {
    ::Window root = 0, parent = 0, *children = nullptr;
    unsigned n = 0;
    XQueryTree(display_, XDefaultRootWindow(display_), &root, &parent, &children, &n);
    for (unsigned i = 0; i < n; ++i) {
      XTextProperty name = {};  // compound text, which begins as plain text does
      if (XGetWMName(display_, children[i], &name) == 0 || name.value == nullptr) continue;
      if (name.nitems >= title.size() && std::memcmp(name.value, title.data(), title.size()) == 0)
        window_ = children[i];
      XFree(name.value);
    }
    XFree(children);
    if (window_ != 0) XSetInputFocus(display_, window_, RevertToParent, CurrentTime);
    XSync(display_, False);
  }
  ~WindowHand() { XCloseDisplay(display_); }
  WindowHand(const WindowHand&) = delete;
  WindowHand& operator=(const WindowHand&) = delete;

  bool found() const { return window_ != 0; }
  void move(int x, int y) {
    XWarpPointer(display_, 0, window_, 0, 0, 0, 0, x, y);
    XSync(display_, False);
  }
  /// @param shifted  the shift key is down meanwhile
  void key(KeySym key, bool down, bool shifted = false) {
    XEvent event = {};
    event.xkey.type = down ? KeyPress : KeyRelease;
    event.xkey.display = display_;
    event.xkey.window = window_;
    event.xkey.root = XDefaultRootWindow(display_);
    event.xkey.keycode = XKeysymToKeycode(display_, key);
    event.xkey.same_screen = True;
    event.xkey.state = shifted ? ShiftMask : 0;
    send(event, down ? KeyPressMask : KeyReleaseMask);
  }
  /// Down or up, where the cursor is: 1 left, 3 right.
  void button(unsigned number, bool down) {
    XEvent event = {};
    event.xbutton.type = down ? ButtonPress : ButtonRelease;
    event.xbutton.display = display_;
    event.xbutton.window = window_;
    event.xbutton.root = XDefaultRootWindow(display_);
    event.xbutton.button = number;
    event.xbutton.same_screen = True;
    send(event, down ? ButtonPressMask : ButtonReleaseMask);
  }
  void click(unsigned number) {
    button(number, true);
    button(number, false);
  }
  /// One notch away from the person (up) or towards.
  void wheel(bool away) { click(away ? 4 : 5); }

 private:
  void send(XEvent& event, long mask) {
    XSendEvent(display_, window_, True, mask, &event);
    XSync(display_, False);
  }
  Display* display_;
  ::Window window_ = 0;
};

}  // namespace palpate::render::test
