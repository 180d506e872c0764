#pragma once
// Where a sharp tip comes through the surface of a body from outside: its way in a step against each facet near it, while
// both move.
//
// A facet is two triangles. The tip comes through one where it is in front of its plane when the step begins and behind
// it when the step ends, and between the corners when it is in it; both move straight meanwhile.

#include <optional>
#include <vector>

#include "physics_node/contact/point_tool.h"
#include "physics_node/contact/tool_contact.h"

namespace palpate::physics {

class TipEntry {
 public:
  /// @param body  of finite elements; outlives this
  explicit TipEntry(const TouchableBody& body);

  /// Before the steps of a frame: which facets the tip may come to. @param way  of it in the frame [m]
  /// Cost: that of ToolContact::look(), and none where the body is far.
  void look(const Vec3& tip, double way, double t) noexcept;
  bool is_near() const noexcept { return !near_.empty(); }
  /// Before a step: where the facets are.
  void begin_step() noexcept;
  struct Through {
    Vec3 rest = Vec3::Zero();  // of the place through which the tip has come [m]
    Vec3 out = Vec3::UnitZ();  // of the surface there now, unit
    bool rigid = false;        // it is of scenery
  };
  /// After it. @return the first on its way
  std::optional<Through> come_through(const Vec3& before, const Vec3& now) const noexcept;

 private:
  static constexpr std::size_t most_facets = 4096;
  using Corners = std::array<Vec3, 4>;
  Corners places(std::uint32_t facet) const noexcept;

  const TouchableBody& body_;
  ToolContact contact_;
  std::vector<std::uint32_t> near_;
  std::vector<Corners> before_;  // of each of near_
};

}  // namespace palpate::physics
