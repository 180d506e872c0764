#pragma once
// Scissors of a scene: two straight blades on a pivot, and where their edges cross.
//
//   x = e / sin(theta / 2),   |dx / dtheta| = e cos(theta / 2) / (2 sin^2(theta / 2))
//
// theta is what the blades are open by, e how far each edge passes the pivot by, x from the pivot to where the edges
// cross, on the line in the middle of the mouth. A sheet of thickness h and toughness Gc that they cut there asks
// T = Gc h |dx / dtheta| of the hand that closes them, by virtual work. Along a blade the crossing lies
// e / tan(theta / 2) from where the edge passes the pivot.
// Source: Mahvash and others 2008 (scissors as a moving crossing of their edges).

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpate {

struct ScissorsSpec {
  double length = 0.03;                   // of a blade's edge, from beside the pivot to its tip [m]
  double opening = std::numbers::pi / 3;  // between the blades as far as they open [rad]
  double offset = 0.003;                  // e [m]
  double close_s = 0.5;                   // from open to closed [s]
  double friction = 0.3;                  // Coulomb's coefficient between a blade and tissue

  double angle(double crossing) const noexcept { return 2 * std::asin(std::min(1.0, offset / crossing)); }
  /// |dx / dtheta| there [m].
  double way_by_angle(double crossing) const noexcept {
    return crossing * along_blade(crossing) / (2 * offset);
  }
  /// x of blades that are open, and of such as are closed, whose tips cross [m].
  double open_crossing() const noexcept { return offset / std::sin(0.5 * opening); }
  double closed_crossing() const noexcept { return std::hypot(length, offset); }
  /// By which it goes on [m/s].
  double speed() const noexcept { return (closed_crossing() - open_crossing()) / close_s; }
  /// Between the tips of blades that are open [m].
  double mouth() const noexcept {
    return 2 * (length * std::sin(0.5 * opening) - offset * std::cos(0.5 * opening));
  }
  /// Share of what would push tissue out of the mouth that friction on the blades takes: friction / tan(theta / 2).
  double gripped(double crossing) const noexcept {
    return std::min(1.0, friction * along_blade(crossing) / offset);
  }
  /// From beside the pivot, on either of them [m].
  double along_blade(double crossing) const noexcept {
    return std::sqrt(std::max(0.0, crossing * crossing - offset * offset));
  }
};

}  // namespace palpate
