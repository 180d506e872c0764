#pragma once
// A needle in one body: the channel that it has made. That is a row of places of the tissue, from where it went in to
// where it has come to. Each holds the shaft across, and rubs on it along; the last one, its end, stands before the tip.
//
//   along a, the needle's direction:  f_n = k_n (b . a - c_n - x_n . a),   |f_n| <= f l_n: beyond that c_n follows
//   at the end of the channel:        t = k (b - x_t) . a,   0 <= t <= T = Gc d min(|F^-1 a|, p): beyond that the tip goes on
//   to enter:                         the same up to p Gc d, along and across together within 5 %
//   across:                           p_n = k_n (1 - a a^T) (b - x_n),   |p_n| <= p Gc l_n: beyond that x_n goes along
//   K (h - b) = sum of f_n a + p_n + t a
//
// h is where the hand has the tip, b where it is; needle and handle are without mass, and the attitude is the hand's. K
// is the hand's spring, k_n how stiffly tissue holds the needle near to it (near_needle.h), l_n the length of shaft that a place answers for, c_n where on the shaft that
// holds it (dry friction with a bristle), f friction by length. Gc is the tissue's toughness, d the diameter: a tip opens
// a crack as wide as that, by Gc times its area at rest; p is the puncture ratio. Drawn back, the needle only rubs, and
// what it has opened it finds open, unless it comes back beside it by more than its diameter: then it cuts anew from there.
// A shaft that is forced aside cuts with all of its length, by p Gc; at a free face it comes out.
//
// Shaft that comes to a place brings no force along, as it goes where it is. So where l_n grows to l_n', c_n and x_n take
// over of what holds it the part that is new,
//
//   b - x_n -> r (b - x_n),   r = l_n / l_n'
//
// or a spring would be stretched that nobody has stretched. Bone ahead holds the tip, and aside what is softer there.
//
// Force and tissue are solved for together, as of a blade (blade_edge.h): k_n / (1 + g_n), g_n the sum of a row of the
// compliance of a step.
// Source: Okamura, Simone & O'Leary 2004 (force of a needle: stiffness of the capsule, friction along the shaft,
// cutting); Mahvash & Hayward 2001 (cutting as toughness times area).
// Limits: the channel is a line, no element parts; one that the needle has left for good is forgotten.

#include <span>
#include <vector>

#include "physics_node/contact/near_needle.h"
#include "physics_node/contact/pierced_tissue.h"
#include "physics_node/contact/tip_entry.h"

namespace palpate::physics {

struct NeedleSpec {
  double diameter = 0, length = 0;  // [m]
  double friction = 0;              // f, by length of shaft in tissue [N/m]
};

/// Of one step.
struct NeedleOutcome {
  Vec3 force = Vec3::Zero();     // on tissue, all of it [N]
  Vec3 moment = Vec3::Zero();    // about the tip [N m]
  double power = 0;              // with the velocities of begin_step() [W]
  double area = 0, work = 0;     // of the crack: opened [m^2], and what that took [J]
  double rubbed = 0;             // between shaft and tissue [J]
  bool entered = false;          // the surface has let the tip in
  double across = 0, along = 0;  // how stiffly tissue holds the needle by what did not slip [N/m]
};

class NeedleChannel {
 public:
  static constexpr std::size_t most_places = 256;  // the last sixteen for where it comes in and out of walls

  NeedleChannel(const BodyModel& body, const NeedleSpec& needle);

  /// Does it touch the body?
  bool holds() const noexcept { return end_ != End::nowhere; }
  /// How much of the shaft is in tissue, as that was at rest [m].
  double depth() const noexcept;
  void let_go() noexcept;

  void begin_step() noexcept;
  /// After a step of dt whose elements have moved the masses. @param entry  of the same body
  /// @param hand, along  where the hand has the tip, and the needle's direction, unit @param stiffness  K [N/m]
  NeedleOutcome step(const TipEntry& entry, const Vec3& hand, const Vec3& along, double stiffness,
                     double dt) noexcept;
  /// Where the tip is [m].
  const Vec3& tip() const noexcept { return tip_; }
  /// Of the last step.
  const std::vector<NodalForce>& forces() const noexcept { return forces_; }
  std::size_t n_held() const noexcept { return n_places_ + (holds() ? 1U : 0U); }

 private:
  static constexpr double skin_beyond = 0.51;  // cells: how far a smooth skin may lie beyond them
  /// Of the channel.
  enum class End { nowhere, surface, tissue, beyond, rigid };
  struct Held {
    PiercedTissue::Place place;
    PiercedTissue::Carriers by;
    Vec3 x = Vec3::Zero(), v = Vec3::Zero();  // now, and before the step
    Vec3 force = Vec3::Zero();                // on tissue [N]
    double slider = 0;                        // c: the shaft's place there, from the tip back [m]
    double length = 0;                        // l [m]
    double room = 0;                          // to the next, as the end has gone on from there [m]
    double along = 0, across = 0;             // k of this step, softened [N/m]
    bool last = false;                        // where the needle came out of the tissue
    bool in = false;                          // the shaft is there
    bool slips = false;                       // across, in this step
    bool torn = false;                        // led aside out of the tissue: it holds nothing any more
  };

  std::span<Held> places() noexcept { return {places_.data(), n_places_}; }
  std::span<const Held> places() const noexcept { return {places_.data(), n_places_}; }
  void put(Held& held, const PiercedTissue::Place& place) const noexcept;
  void begin_at(const PiercedTissue::Place& place) noexcept;
  Held& keep_front() noexcept;
  void find_end(const Vec3& along) noexcept;
  void find_places(const Vec3& along) noexcept;
  void take_in(Held& held, double before, double now, const Eigen::Matrix3d& to_rest,
               const Vec3& along) noexcept;
  bool is_beside(const Held& held, const Vec3& along) const noexcept;
  void leave_at(std::size_t n, const Vec3& rest, const Vec3& along) noexcept;
  void find_holds(double stiffness) noexcept;
  void soften(double Held::*hold, double dt) noexcept;
  NearNeedle near(const ElementLaw& law) const noexcept;
  /// All that tissue presses back with while the tip is so far before the hand [N].
  double along_at(double lag, const Vec3& hand, const Vec3& along) const noexcept;
  void find_tip(const Vec3& hand, const Vec3& along, double stiffness) noexcept;
  void press(const Vec3& along, NeedleOutcome& done) noexcept;
  Vec3 press_aside(Held& held, const Vec3& along, double most, NeedleOutcome& done) noexcept;
  bool slide_on_surface(Held& held, const Vec3& rest, const Vec3& along) noexcept;
  void go_on(const Vec3& along, NeedleOutcome& done) noexcept;
  void draw_back(const Vec3& along) noexcept;
  void meet_surface(const TipEntry& entry, const Vec3& before, const Vec3& along) noexcept;
  double most_ahead() const noexcept;
  bool has_end() const noexcept { return end_ != End::nowhere && end_ != End::beyond; }
  template <class Visit>
  void each_held(const Visit& visit) noexcept {
    for (Held& held : places())
      if (held.in) visit(held);
    if (has_end()) visit(front_);
  }

  PiercedTissue tissue_;
  NeedleSpec needle_;
  double apart_;              // places of the channel [m]
  std::vector<Held> places_;  // n_places_ of them from where it went in, in order; the others are spare
  std::size_t n_places_ = 0;
  Held front_;  // the end of the channel
  End end_ = End::nowhere;
  bool hub_ = false;        // all of the shaft is in tissue: its hub stops it
  bool seen_ = false;       // where the tip was before this step
  bool in_a_cell_ = false;  // the end has come into a cell, from a skin that lies beyond them
  std::size_t entry_ = 0;   // of places_: where the needle went in the last time
  double resistance_ = 0;   // T, at a surface Gc d [N]
  double before_it_ = 0;    // how much of the end holds the tip across, 0 to 1
  Eigen::Matrix3d to_rest_ = Eigen::Matrix3d::Identity();  // F^-1 at the end
  Vec3 tip_ = Vec3::Zero(), off_ = Vec3::Zero();           // off_: of the tip from the hand [m]
  Index copies_ = 0;
  std::vector<double> pull_;  // by node
  std::vector<NodalForce> forces_;
};

}  // namespace palpate::physics
