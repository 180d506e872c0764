#pragma once
// One body as contact sees it: its candidates, its facets, and what has happened to them since they were last looked at.

#include <memory>
#include <span>

#include "physics_node/collision/facets.h"
#include "physics_node/fragments/fragments.h"

namespace palpate::physics {

class ContactBody {
 public:
  /// @param with_facets  whether facets are followed; else there are none
  /// @param with_front   as for Candidates
  /// @param fragments    of the body; without, every candidate counts as come off
  ContactBody(const BodyModel& moving, bool with_facets, bool with_front,
              const Fragments* fragments = nullptr);

  /// Follows the elements that broke in the last step.
  void follow_breaks() noexcept;
  /// Finds everything anew.
  void restart() noexcept;
  /// As Candidates::refresh(), of all.
  bool refresh(double dt) noexcept { return read(dt, candidates_.all()); }
  /// The same of those that are in a list of pairs; what speed() and moved() tell is then of these.
  bool refresh_listed(double dt) noexcept { return read(dt, listed_); }
  void clear_listed() noexcept;
  void list(std::uint32_t candidate) noexcept;
  std::span<const std::uint32_t> listed() const { return listed_; }
  /// Of a candidate when last refreshed, against the common velocity [m/s].
  double speed_of(std::size_t candidate) const { return speeds_[candidate]; }
  /// Of the fastest of those that were.
  double speed() const { return speed_; }
  /// All were read, and this is what the body does as a whole (common_motion.h): speeds are against it, as
  /// it is now and from now on.
  void go_with(const Vec3& velocity) noexcept;
  const Vec3& common_velocity() const { return common_; }
  /// A step of dt ends: moved() leaves out what is common in it.
  void end_step(double dt) noexcept { shift_ = dt * common_; }

  /// Since forget_changes(): are candidates or facets not what they were, and how far did a candidate move at most, apart from what all
  /// did together [m], and that [m]?
  bool has_changed() const { return changed_; }
  double moved() const { return moved_; }
  const Vec3& shifted() const { return shifted_; }
  void forget_changes() noexcept { changed_ = false, moved_ = 0, shifted_.setZero(); }

  /// Round all candidates, where they were when last refreshed.
  Eigen::AlignedBox3d box() const noexcept;

  /// Can this candidate meet others of its own body? It can where it has lost an element, and everywhere on what has come
  /// off. What is whole folds through itself, as a body does that has not broken anywhere.
  bool may_meet_itself(std::size_t candidate) const noexcept;
  /// Has any element broken? Then it touches itself too. The sides of a cut through finite elements lie in one place when
  /// they part, and are not held apart.
  bool touches_itself() const {
    return moving().breaks() > 0 && !moving().body().mesh && moving().body().cell_net() == nullptr;
  }

  const Candidates& candidates() const { return candidates_; }
  const Facets* facets() const { return facets_.get(); }
  const BodyModel& moving() const { return candidates_.moving(); }

 private:
  bool read(double dt, std::span<const std::uint32_t> which) noexcept;
  void measure_speed(std::span<const std::uint32_t> which) noexcept;
  void find_main_piece() noexcept;

  Candidates candidates_;
  const Fragments* fragments_;
  Index main_piece_ = 0;  // label of the largest fragment
  std::unique_ptr<Facets> facets_;
  std::vector<std::uint32_t> listed_;
  std::vector<std::uint8_t> is_listed_;  // of each candidate
  std::vector<double> speeds_;           // of each candidate [m/s]
  Vec3 common_ = Vec3::Zero();           // velocity [m/s]
  Vec3 shift_ = Vec3::Zero();            // by it since the last reading [m]
  Vec3 shifted_ = Vec3::Zero();
  double speed_ = 0;
  double moved_ = 0;
  bool changed_ = true;
};

/// Where the candidates of each body begin when those of all are counted through, and how many there can be in all  (n + 1)
std::vector<std::uint32_t> first_candidates(const std::vector<ContactBody>& bodies);

/// Distance between two boxes along the axis on which they are farthest apart; negative where they overlap [m].
double gap_between(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b) noexcept;

}  // namespace palpate::physics
