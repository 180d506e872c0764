#pragma once
// A tool that presses tissue by forces on its masses, which the elements' own step then takes in.

#include <span>

#include "physics_node/body/topology_events.h"
#include "physics_node/connection/strands.h"
#include "physics_node/contact/tool.h"

namespace palpate::physics {

struct CutWork {
  double hand = 0;      // that the hand pays [J]
  double released = 0;  // that elements pay which were cut before [J]
};

class PressingTool : public Tool {
 public:
  /// Forces on masses of the touched body during the coming frame; none: it touches nothing, or does not press.
  virtual std::span<const NodalForce> forces() const noexcept = 0;
  /// Of a tool that presses several bodies at once: on masses of any.
  virtual std::span<const NodalForce> forces_on(std::size_t body) const noexcept {
    return body == touched_body() ? forces() : std::span<const NodalForce>();
  }
  virtual bool presses() const noexcept { return !forces().empty(); }  // any body
  /// May forces() come in the coming frame?
  virtual bool may_press() const noexcept = 0;
  /// Of those that it touches the one that it is at; meaningful while forces() or cuts() are not empty.
  virtual std::size_t touched_body() const noexcept = 0;

  /// Are forces() found in every step anew, from where its elements have moved the masses (explicit integrators), rather than known
  /// before the frame?
  virtual bool follows_steps() const noexcept = 0;
  /// Of one that does: before a step.
  virtual void begin_step() noexcept = 0;
  /// Of one that does: finds forces(), which act in the step of dt whose elements have just moved the masses.
  /// @return their power with the velocities of begin_step() [W]
  virtual double press(double dt) noexcept = 0;
  /// Elements of the touched body that it has cut in the step of press().
  virtual std::span<const EdgeGone> cuts() const noexcept { return {}; }
  /// What it does to the strands of a connection in the step of press().
  virtual std::span<const StrandPush> pushes([[maybe_unused]] std::size_t connection) const noexcept {
    return {};
  }
  /// What that step's way through tissue took: toughness times area.
  virtual CutWork cut_work() const noexcept { return {}; }
  /// What the elements of cuts() held [J].
  virtual void take_released([[maybe_unused]] double energy) noexcept {}

 protected:
  using Tool::Tool;
};

}  // namespace palpate::physics
