#pragma once
// What keys and mouse did between two pictures, from events: a tap counts however short it is and however seldom a picture
// comes. No window in here: the window passes its events on.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <map>

namespace palpate::render {

class HandEvents {
 public:
  static constexpr double tap_s =
      1.0 / 30;  // how long a key is taken to have been down that came and went in one poll [s]

  void key(int code, bool down) {
    Key& key = keys_[code];
    if (down && !key.down) ++key.presses;
    key.down = down;
  }
  void button(int number, bool down) {
    if (number >= 0 && number < static_cast<int>(down_.size()))
      down_[static_cast<std::size_t>(number)] = down;
  }
  void cursor(double x, double y) {
    const Eigen::Vector2d now(x, y);
    if (known_)
      for (std::size_t b = 0; b < down_.size(); ++b)
        if (down_[b]) drag_[b] += now - cursor_;
    cursor_ = now;
    known_ = true;
  }
  /// The window is no longer spoken to: what was down is up.
  void leave() {
    for (auto& [code, key] : keys_) key.down = false;
    down_ = {};
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
  /// Way of the cursor with this button down since the last picture [px].
  const Eigen::Vector2d& drag(std::size_t button) const { return drag_[button]; }

  /// The picture has been drawn.
  void forget() {
    for (auto& [code, key] : keys_) key.presses = 0;
    drag_ = {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  }

 private:
  struct Key {
    bool down = false;
    int presses = 0;
  };
  std::map<int, Key> keys_;
  std::array<bool, 2> down_{};  // left, right
  std::array<Eigen::Vector2d, 2> drag_{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  Eigen::Vector2d cursor_ = Eigen::Vector2d::Zero();
  bool known_ = false;
};

}  // namespace palpate::render
