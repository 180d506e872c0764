#pragma once
// What keys and mouse did between two pictures, from events: a tap counts however short it is and however seldom a picture
// comes. No window in here: the window passes its events on.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <map>
#include <optional>

namespace palpate::render {

class HandEvents {
 public:
  static constexpr double tap_s =
      1.0 / 30;  // how long a key is taken to have been down that came and went in one poll [s]

  static constexpr double click_px = 4;  // a button that goes down and up within this way is a click

  void key(int code, bool down) {
    Key& key = keys_[code];
    if (down && !key.down) ++key.presses;
    key.down = down;
  }
  /// A character was typed, on whatever keys a keyboard has for it: as a key of its own that came and went.
  void character(unsigned c) {
    if (c >= most_characters) return;  // Why: what is remembered is bounded
    key(of_character(c), true);
    key(of_character(c), false);
  }
  static constexpr int of_character(unsigned c) { return first_character + static_cast<int>(c); }

  void button(int number, bool down) {
    if (number < 0 || number >= static_cast<int>(buttons_.size())) return;
    Button& button = buttons_[static_cast<std::size_t>(number)];
    if (button.down && !down && !button.drags) {
      ++button.clicks;
      button.clicked = cursor_;
    }
    if (down && !button.down) button.drags = false, button.way.setZero();
    button.down = down;
  }
  void cursor(double x, double y) {
    const Eigen::Vector2d now(x, y);
    for (Button& button : buttons_) {
      if (!known_ || !button.down) continue;
      button.way += now - cursor_;
      if (!button.drags && button.way.norm() <= click_px) continue;
      button.drags = true;
      button.drag += button.way;
      button.way.setZero();
    }
    cursor_ = now;
    known_ = true;
  }
  /// The window is no longer spoken to: what was down is up.
  void leave() {
    for (auto& [code, key] : keys_) key.down = false;
    for (Button& button : buttons_) button.down = false;
  }

  /// Times that the key went down since the last picture.
  int presses(int code) const {
    const auto key = keys_.find(code);
    return key == keys_.end() ? 0 : key->second.presses;
  }
  /// Down now, or at some time since the last picture.
  bool down(int code) const {
    const auto key = keys_.find(code);
    return key != keys_.end() && (key->second.down || key->second.presses > 0);
  }
  /// How long it was down since the last picture, `seconds` ago [s].
  double held(int code, double seconds) const {
    const auto key = keys_.find(code);
    if (key == keys_.end()) return 0;
    if (key->second.down && key->second.presses == 0) return seconds;
    return std::min(seconds, tap_s * key->second.presses);
  }
  /// Way of the cursor with this button down since the last picture, of drags only [px].
  const Eigen::Vector2d& drag(std::size_t button) const { return buttons_[button].drag; }
  /// Where this button was last clicked since the last picture [px]; nothing: it was not, or it was dragged.
  std::optional<Eigen::Vector2d> click(std::size_t button) const {
    return buttons_[button].clicks > 0 ? std::optional(buttons_[button].clicked) : std::nullopt;
  }

  /// The picture has been drawn.
  void forget() {
    for (auto& [code, key] : keys_) key.presses = 0;
    for (Button& button : buttons_) button.drag.setZero(), button.clicks = 0;
  }

 private:
  static constexpr int first_character = 1 << 16;  // Why: above all codes of GLFW
  static constexpr unsigned most_characters = 128;
  struct Key {
    bool down = false;
    int presses = 0;
  };
  std::map<int, Key> keys_;
  struct Button {
    bool down = false, drags = false;
    int clicks = 0;
    Eigen::Vector2d drag = Eigen::Vector2d::Zero(), way = Eigen::Vector2d::Zero(), clicked = way;
  };
  std::array<Button, 2> buttons_{};  // left, right
  Eigen::Vector2d cursor_ = Eigen::Vector2d::Zero();
  bool known_ = false;
};

}  // namespace palpate::render
