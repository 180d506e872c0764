#pragma once
// A sharp edge in tissue: strips of it, each of which slides against the tissue's toughness as dry friction would.
//
//   F_i = k_i (b - x_i) . ahead,   0 <= F_i <= (1 - c) T_i,   T_i = Gc l_i a_i
//   (1 - s) sum of F_i = K (h - b) . ahead,   on tissue (1 - s) F_i
//
// Where F_i would be more, x_i goes on until it is not. h is where the hand has the blade, b where it is, which is rigid
// and without mass, x_i where the strip is in the tissue. K is the hand's spring, k_i the stiff hold of a strip on
// tissue, a_i the area at rest of what it passes by its area now, c the share that elements pay which were cut before
// (Griffith 1921), s the share that the tool itself holds tissue against: 0 of a single edge (scissor_blades.h). Tissue
// carries x_i along; when the hand goes back nothing pulls. The work of going on, sum of T_i dx_i, is Gc times the area
// that has been opened, as it was at rest. Elements that a strip has slid past are cut. So the force is that of the
// tissue and not of the lattice. Across, the slot holds the blade alike, both ways. Along itself the edge is free.
//
// Force and tissue are solved for together, as masses beside an edge are light: with F at the end of the step,
//   F_i (1 + g_i) = k_i (b - x_i),  g_i = dt^2 sum over n of w_in / m_n sum over j of w_jn k_j
// the sum of a row in place of the matrix, which is exact where gaps are alike and never too stiff.
// Source: Mahvash & Hayward 2001 (energy of a sharp cut); sliders as dry friction: Haessig & Friedland 1991.
// Deviation: what elements held is spread over the next four spacings, so that the force does not jump with each.

#include <limits>
#include <span>
#include <vector>

#include "physics_node/contact/blade_strands.h"
#include "physics_node/contact/blade_strips.h"

namespace palpate::physics {

class BladeEdge {
 public:
  /// @param n_strips  of equal length @param stiffness  of the hand's spring, all of it [N/m]
  BladeEdge(double length, std::size_t n_strips, double stiffness);

  /// How stiff the hand's spring is now [N/m].
  void set_stiffness(double stiffness) noexcept { stiffness_ = stiffness; }
  /// How fast it may go on at most through tissue that lets go of it, so that it passes by nothing that is not listed [m/s].
  void set_fastest(double speed) noexcept { fastest_ = speed; }
  /// What share of it the tool holds tissue against by itself, so that neither hand nor tissue bears that: s.
  void set_gripped(double share) noexcept { borne_ = 1 - share; }
  /// Does it cut? Else it is held where it bites, by a force without a limit, and bites nothing else.
  void set_sharp(bool sharp) noexcept { sharp_ = sharp; }
  /// After a step of dt: slides, finds forces on the nodes of `links` and on `strands`, and lists in `cuts` the
  /// elements that it has passed.
  BladeOutcome step(BladeLinks& links, BladeStrands& strands, const BladeFrame& frame, double dt,
                    std::vector<EdgeGone>& cuts) noexcept {
    return advance(links, strands, frame, dt, cuts, false);
  }
  /// The same of an edge that nothing can stop: it goes on to where the hand has it, and all that it has passed is cut.
  BladeOutcome go_through(BladeLinks& links, BladeStrands& strands, const BladeFrame& frame, double dt,
                          std::vector<EdgeGone>& cuts) noexcept {
    return advance(links, strands, frame, dt, cuts, true);
  }
  /// What the elements held that the last step's list names [J].
  void take_released(double energy) noexcept { coming_ += energy; }
  void let_go() noexcept;

  /// Is any of it in springs?
  bool bites() const noexcept { return bites_; }
  EdgePlace place() const noexcept;
  /// What the hand feels of its spring ahead and across as long as nothing goes on [N/m].
  double felt_ahead(const BladeStrands& strands) const noexcept {
    return felt(borne_ * (held() + strands.held()));
  }
  double felt_across() const noexcept { return felt(held()); }

 private:
  BladeOutcome advance(BladeLinks& links, BladeStrands& strands, const BladeFrame& frame, double dt,
                       std::vector<EdgeGone>& cuts, bool through) noexcept;
  void touch(BladeLinks& links, const BladeFrame& frame) noexcept;
  void touch_wall(const BladeLinks& links) noexcept;
  void find_slot() noexcept;
  void soften(BladeLinks& links, double dt) noexcept;
  /// Of a strip on the tissue, all of which is before it [N/m].
  double hold() const noexcept { return held_by * stiffness_ * strips_.width() / strips_.length(); }
  /// Of as much of a strip as tissue is before, and as softly as that gives way in a step [N/m].
  double hold_of(const BladeStrip& strip) const noexcept {
    return hold() * strip.cover / (1 + strip.softness);
  }
  /// What it opens by the way that it goes on [m].
  double width_at_rest(const BladeStrip& strip) const noexcept {
    return strip.cover * strips_.width() * strip.unstrained * strip.even;
  }
  /// What that takes, and what the hand has to press with for it [N].
  double resistance(const BladeStrip& strip) const noexcept { return strip.toughness * width_at_rest(strip); }
  double most_force(const BladeStrip& strip) const noexcept {
    return sharp_ ? (1 - from_tissue_) * resistance(strip) : std::numeric_limits<double>::max();
  }
  void share_released(const BladeLinks& links, double dt) noexcept;
  double hold_ahead(double q) const noexcept;
  double held() const noexcept;  // how stiffly all strips hold it [N/m]
  double felt(double held) const noexcept { return held > 0 ? stiffness_ * held / (stiffness_ + held) : 0.0; }
  void find_blade(const BladeStrands& strands, double dt) noexcept;
  void slide(BladeStrip& strip, bool through, BladeOutcome& done) const noexcept;
  void press(BladeLinks& links, const BladeFrame& frame, double dt, BladeOutcome& done) noexcept;
  void cut(BladeLinks& links, const Vec3& side, bool through, std::vector<EdgeGone>& cuts) noexcept;

  static constexpr double held_by =
      20;  // Why: an edge of which a fifth is in tissue is still four times as stiff as the hand's spring

  double stiffness_, fastest_ = 1e9, borne_ = 1;
  BladeStrips strips_;
  bool bites_ = false, sharp_ = true;
  double slot_ = 0, lag_ = 0, aside_ = 0;  // of the slot across; of the blade ahead and across
  double lag_before_ = 0;
  double coming_ = 0,
         purse_ = 0;        // energy of elements that were cut, and what of it may be paid with now [J]
  double from_tissue_ = 0;  // share of the toughness that it pays now
  bool seen_ = false;
  BladeFrame before_;
};

}  // namespace palpate::physics
