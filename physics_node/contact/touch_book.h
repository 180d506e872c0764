#pragma once
// What a hand and the tissue under its tool have done to each other: two works that are equal where the hand
// feels what the tissue bears, and by how much what it felt was more.

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "common/message/messages.h"
#include "physics_node/contact/handle.h"

namespace palpate::physics {

class TouchBook {
 public:
  /// A state of the hand that has come, newer than the last. The work of its way since then by the trapezoid
  ///   W += (f + f') / 2 . (x' - x) + (m + m') / 2 . turn,   f, m what the hand pressed with, against what it felt
  /// so what swings faster than states come is not seen.
  void hand(const ToolState& state) noexcept;
  /// The hand is somewhere else when it comes next: nobody knows what it did meanwhile.
  void lose_hand() noexcept { seen_ = false; }
  /// A step of the tool's forces on tissue, as the ledger has it. @return work [J]
  double tissue(double work) noexcept {
    if (std::isfinite(work)) tissue_work_ += work;
    return work;
  }
  /// A step of a blade. @param area  that it has opened [m^2] @param work  that this took [J]
  void cut(double area, double work) noexcept { cut_area_ += area, cut_work_ += work; }
  /// A step of scissors. @param torque  of the handles [N m] @param work  of closing them [J]
  void closed(double torque, double work) noexcept {
    handle_torque_ = std::max(handle_torque_, torque), handle_work_ += work;
  }
  /// A step of a needle. @param depth  of it in tissue [m] @param rubbed  work of its shaft [J] @param entered  the force with which it came
  /// through a surface; 0: it did not [N]
  void pierced(double depth, double rubbed, double entered) noexcept {
    deepest_ = std::max(deepest_, depth), rubbed_ += rubbed;
    if (entered > 0) ++punctures_, puncture_force_ = std::max(puncture_force_, entered);
  }
  /// Area that its edge has swept inside each body of the scene that it neither cuts nor feels; outlives this [m^2]
  void passed_unfelt(std::span<const double> areas) noexcept { passed_ = areas; }
  /// A frame in which tissue bore this force [N].
  void frame(const Vec3& borne) noexcept;

  double hand_work() const noexcept { return hand_work_; }      // by the hand on what it felt [J]
  double tissue_work() const noexcept { return tissue_work_; }  // by the tool on tissue [J]
  std::span<const double> passed_unfelt() const noexcept { return passed_; }  // by body; EMPTY: none ever
  double cut_area() const noexcept { return cut_area_; }                      // opened by a blade [m^2]
  double cut_work() const noexcept { return cut_work_; }  // that this took, of the hand or of the tissue [J]
  double handle_torque() const noexcept { return handle_torque_; }    // of scissors, the most [N m]
  double handle_work() const noexcept { return handle_work_; }        // of closing them [J]
  double deepest() const noexcept { return deepest_; }                // of a needle in tissue [m]
  double rubbed() const noexcept { return rubbed_; }                  // by its shaft [J]
  int punctures() const noexcept { return punctures_; }               // surfaces that it has come through
  double puncture_force() const noexcept { return puncture_force_; }  // the most that took [N]
  /// Root mean square of the force on the hand over that of the force that tissue bore, of all frames; none:
  /// tissue bore nothing.
  std::optional<double> felt_over_true_rms() const noexcept {
    if (!(borne2_ > 0)) return std::nullopt;
    return std::sqrt(felt2_ / borne2_);
  }

  /// The same of their difference, in the same frame: what hides in sizes that agree, late or another way.
  std::optional<double> felt_off_rms() const noexcept {
    if (!(borne2_ > 0)) return std::nullopt;
    return std::sqrt(off2_ / borne2_);
  }

 private:
  bool seen_ = false;
  Pose at_;                                 // of the hand
  Vec6 load_ = Vec6::Zero();                // that it pressed with [N], [N m]
  double hand_work_ = 0, tissue_work_ = 0;  // [J]
  std::span<const double> passed_;
  double cut_area_ = 0, cut_work_ = 0;                    // [m^2], [J]
  double handle_torque_ = 0, handle_work_ = 0;            // [N m], [J]
  double deepest_ = 0, rubbed_ = 0, puncture_force_ = 0;  // [m], [J], [N]
  int punctures_ = 0;
  double felt2_ = 0, borne2_ = 0, off2_ = 0;  // sums over frames [N^2]
};

}  // namespace palpate::physics
