#pragma once
// A tool that presses tissue by forces on its masses, which the elements' own step then takes in.

#include <span>

#include "physics_node/contact/tool.h"

namespace palpate::physics {

class PressingTool : public Tool {
 public:
  /// Forces on masses of the touched body during the coming frame; none: it touches nothing, or does not press.
  virtual std::span<const NodalForce> forces() const noexcept = 0;
  virtual std::size_t touched_body() const noexcept = 0;  // meaningful while forces() is not empty

 protected:
  using Tool::Tool;
};

}  // namespace palpate::physics
