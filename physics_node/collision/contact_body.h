#pragma once
// One body as contact sees it: its candidates, its facets, and how far they have moved since they were last looked at.

#include <memory>
#include <span>

#include "physics_node/collision/facets.h"

namespace palpate::physics {

class ContactBody {
 public:
  /// @param with_facets  whether facets are followed; else there are none
  /// @param with_front   as for Candidates
  ContactBody(const MovingBody& moving, bool with_facets, bool with_front);

  /// Follows the elements that broke in the last step. @return true if candidates or facets are not what they were
  bool follow_breaks() noexcept;
  /// Finds everything anew.
  void restart() noexcept;
  /// As Candidates::refresh().
  bool refresh(double dt) noexcept;
  /// Of the fastest candidate when last refreshed [m/s].
  double speed() const { return speed_; }

  /// Remembers where the candidates are now.
  void mark() noexcept;
  /// Since then: the mean displacement, and how far a candidate strayed from it at most [m].
  const Vec3& drift() const { return drift_; }
  double stray() const { return stray_; }
  void measure_motion() noexcept;

  /// Round all candidates, where they were when last refreshed.
  Eigen::AlignedBox3d box() const noexcept;

  /// Has any element broken? Then it touches itself too.
  bool touches_itself() const { return moving().breaks() > 0; }

  const Candidates& candidates() const { return candidates_; }
  const Facets* facets() const { return facets_.get(); }
  const MovingBody& moving() const { return candidates_.moving(); }

 private:
  Candidates candidates_;
  std::unique_ptr<Facets> facets_;
  std::vector<Vec3> marked_;
  std::size_t n_marked_ = 0;
  Vec3 drift_ = Vec3::Zero();
  double stray_ = 0;
  double speed_ = 0;
};

/// Where the candidates of each body begin when those of all are counted through, and how many there can be in all  (n + 1)
std::vector<std::uint32_t> first_candidates(const std::vector<ContactBody>& bodies);

/// Distance between two boxes along the axis on which they are farthest apart; negative where they overlap [m].
double gap_between(const Eigen::AlignedBox3d& a, const Eigen::AlignedBox3d& b) noexcept;

}  // namespace palpate::physics
