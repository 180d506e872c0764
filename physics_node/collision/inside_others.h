#pragma once
// How many masses of a body lie inside another one: the measure of what contact should not let happen.
//
// Measured against what the other body is now, not against contact distances: its filled volumes with their corners where they
// are (boundary/filled_volumes.h), and its rigid scenery, which stays where it is. What broke open has no inside.

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "physics_node/boundary/filled_volumes.h"
#include "physics_node/collision/point_grid.h"
#include "physics_node/fragments/fragments.h"
#include "physics_node/step/body_model.h"

namespace palpate::physics {

class InsideOthers {
 public:
  /// @param bodies  which outlive this
  explicit InsideOthers(const BodyModels& bodies);

  /// Counts once. Contract: allocates and throws nothing. Cost: a pass over all masses for the boxes round the bodies, some
  /// 5 ns each; where two boxes overlap, the masses and volumes there.
  void look() noexcept;
  /// For a frame in which bodies are near: looks in one frame of so many that it is a small part of what the frames cost.
  void look_now_and_then() noexcept;
  void restart() noexcept;
  /// Masses of a body inside another of its own fragments; for reports. Cost: all its masses and volumes.
  Index between_pieces(std::size_t body, const Fragments& fragments) noexcept;

  /// Masses of a body inside any other when last looked, and in the look that found most.
  Index now(std::size_t body) const { return now_[body]; }
  Index most(std::size_t body) const { return most_[body]; }
  bool any() const noexcept;

 private:
  struct Other {
    const BodyModel* moving;
    FilledVolumes volumes;
    std::vector<Vec3> rest{};  // of each node, in order [m]
    bool has_scenery = false;
    Eigen::AlignedBox3d box{}, scenery{};  // as last looked; of its rigid cells
  };
  void find_box(Other& body) noexcept;
  void take_points(const Other& of, const Eigen::AlignedBox3d& box, const Fragments* apart) noexcept;
  Eigen::AlignedBox3d overlap_of(std::size_t body) const noexcept;
  void mark_in_volumes(const Other& outer, const Fragments* apart) noexcept;
  void mark_in_tetrahedron(const std::array<Vec3, 4>& corner, Index piece) noexcept;
  Index marked() const noexcept;
  void mark_in_scenery(const Other& outer) noexcept;

  std::vector<Other> bodies_;
  std::vector<Index> now_, most_;  // by body
  std::size_t room_;               // for points; a copy has it, too, whatever its vectors have kept
  PointGrid grid_;                 // masses of the body that is looked at
  std::vector<Vec3> point_;
  std::vector<Index> piece_;          // that each point belongs to: a fragment of its own body
  std::vector<std::uint8_t> inside_;  // of each point
  Eigen::AlignedBox3d near_;          // round the points
  double cell_ = 0;                   // of the grid [m]
  int frames_between_ = 1, frames_left_ = 0;
};

}  // namespace palpate::physics
