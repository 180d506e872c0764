#pragma once
// The strips of a sharp edge: where each is in the tissue, what it holds on to there, and what area at rest it passes.
//
// A strip presses on the elements that cross the blade's plane before it, with weights that fall with how far ahead they
// are. Tissue carries it along by those same weights, so that what the hand gives is what tissue gets. Masses go to and
// fro within a step by much more than they get on: weights of another moment would let it creep through tissue unpaid.

#include <algorithm>
#include <cmath>
#include <vector>

#include "physics_node/contact/blade_links.h"

namespace palpate::physics {

struct BladeStrip {
  bool bites = false, new_bite = true, follows = false;
  double slid = 0, slid_before = 0;  // in this step, in the last [m]
  Vec3 x = Vec3::Zero();             // its middle, in the tissue [m]
  double q = 0, r = 0;               // of that, in the blade's frame
  double last_q = 0;                 // q when the last step ended
  double held_q = 0;                 // q when it was found what it presses on
  double weight = 0;                 // of all that it presses on
  double toughness = 0;              // of these [J/m^2]
  double low = 0, high = 0;          // p of the outermost of them [m]
  double cover = 0;                  // share of its width that lies between
  double unstrained = 1;         // area at rest of what the edge passes by its area now; of a surface, way
  double booked = 0;             // area at rest that it has opened since that was counted [m^2]
  double unpaid = 0;             // that it has passed and not booked, or less than none [m^2]
  double even = 1;               // by how much more it books therefore
  Vec3 front = Vec3::Zero();     // where its middle is in the tissue at rest [m]
  Vec3 onward = Vec3::Zero();    // how far it goes on there by its way now, A below
  double softness = 0;           // g
  Vec3 way = Vec3::Zero();       // that tissue carries it in a step [m]
  double ahead = 0, across = 0;  // force on the tissue [N]
};

class BladeStrips {
 public:
  static constexpr std::size_t most = 64;
  /// In spacings. Why: tissue before an edge moves by little against its neighbours without being cut.
  static constexpr double passed_by = 0.25;

  BladeStrips(double length, std::size_t n)
      : length_(length), width_(length / static_cast<double>(n)), strips_(n) {}

  auto begin() noexcept { return strips_.begin(); }
  auto end() noexcept { return strips_.end(); }
  auto begin() const noexcept { return strips_.begin(); }
  auto end() const noexcept { return strips_.end(); }
  double length() const noexcept { return length_; }
  void let_go() noexcept {
    for (BladeStrip& strip : strips_) strip = {};
    unpaid_ = 0;
  }
  double width() const noexcept { return width_; }  // of one
  double middle(const BladeStrip& strip) const noexcept {
    return (static_cast<double>(&strip - strips_.data()) + 0.5) * width_;
  }
  bool is_along(double p) const noexcept { return p >= 0 && p <= length_; }
  BladeStrip& at(double p) noexcept {
    return strips_[std::min(static_cast<std::size_t>(p / width_), strips_.size() - 1)];
  }

  /// About where tissue has carried them, by what each has pressed on. Who finds none ahead, or was left behind by the
  /// hand, lets go.
  void follow(const BladeLinks& links, const BladeFrame& frame) noexcept;
  /// From now on in this step: who holds on to what, and how much of a strip there is tissue for: as far as there are
  /// elements on both sides.
  void weigh(const BladeLinks& links) noexcept;
  /// Exactly where tissue has carried them, by those weights. What a strip has not gone past by sliding it is not past:
  /// where tissue turns or shears before it, it stays with the element that is farthest behind.
  void carry(const BladeLinks& links, const BladeFrame& frame) noexcept;
  /// Of a step of dt: `unstrained` and `even`.
  void compare_with_rest(const BladeLinks& links, double dt) noexcept;

  /// Those that bite and have nothing before them go with the blade, but not beyond those that have within `reach` along
  /// the edge: a wall that comes from one to the next is met where it is.
  void go_on_uncovered(double lag, double reach) noexcept;

  /// Calls visit(strip) for all of which any part is within `reach` of p.
  template <class Visit>
  void each_near(double p, double reach, const Visit& visit) noexcept {
    reach += 0.5 * width_;
    const double n = static_cast<double>(strips_.size());
    const double first = std::ceil((p - reach) / width_ - 0.5), last = std::floor((p + reach) / width_ - 0.5);
    const auto begin = static_cast<std::size_t>(std::clamp(first, 0.0, n));
    const auto end = static_cast<std::size_t>(std::clamp(last + 1, 0.0, n));
    for (std::size_t i = begin; i < end; ++i) visit(strips_[i]);
  }
  /// Calls visit(link, crossing, strip, weight) for every strip that bites and what it presses on.
  /// @param when  now or before
  template <class Visit>
  void each_held(const BladeLinks& links, BladeLinks::Crossing BladeLinks::Link::*when,
                 const Visit& visit) noexcept {
    const double h = links.spacing();
    for (const BladeLinks::Link& link : links.links()) {
      const BladeLinks::Crossing& at = link.*when;
      if (!at.is || !link.lives) continue;
      each_near(at.p, h, [&](BladeStrip& strip) {
        if (!strip.bites) return;
        if (const double w = weight((at.q - strip.held_q) / h); w > 0) visit(link, at, strip, w);
      });
    }
  }

  /// Of what has changed, how much is taken up in a step in which an edge has slid so far.
  static double evened_part(double slid, double h, double dt) noexcept {
    return std::min(1.0, slid / h + dt / compared_anew_in);
  }
  static constexpr double evened_in =
      2;  // Why: spacings; less, and the force would jump with every element, more, and it would lag behind the tissue

 private:
  static constexpr double ahead_reach =
      1.5;  // Why: a blade between two layers of masses presses on the one ahead whatever the direction
  static constexpr double compared_anew_in = 0.05;  // [s]

  /// Of what lies d spacings ahead of a strip: less the farther, and none where it has been passed, without a jump.
  static double weight(double d) noexcept {
    return std::max(0.0, d < 0 ? 1 + d / passed_by : 1 - d / ahead_reach);
  }
  void cover_wall(const BladeLinks& links, double dt) noexcept;
  void stay_before_elements(const BladeLinks& links) noexcept;
  void count_passed(BladeStrip& strip, const Vec3& front, const Vec3& B) noexcept;

  double length_, width_;
  double unpaid_ = 0;  // of a wall, which goes from strip to strip, as BladeStrip::unpaid [m^2]
  std::vector<BladeStrip> strips_;
};

}  // namespace palpate::physics
