#pragma once
// How much of an image's tissue is around a place: what a mesh of tetrahedra is cut along.

#include "common/record/volume.h"

namespace palpate {

/// Share of tissue in a box of about `grain` round each place, 0 to 1: boxes side by side, linear between their middles. Beyond the image there is
/// none.
class TissueField {
 public:
  /// @param volume  places are counted from the outer corner of its first cell, along its own axes; where these are left-handed x is
  ///                counted from the other end, as in bodies of images [m]
  /// @param keep_min, keep_max  intensities that are tissue, both included
  /// @param largest  only of the largest part that hangs together over sides of cells  @param grain  [m]
  TissueField(const Volume& volume, double keep_min, double keep_max, bool largest, double grain);

  double at(const Eigen::Vector3d& x) const noexcept;
  const Eigen::Vector3d& low() const noexcept { return low_; }    // of the box round all tissue [m]
  const Eigen::Vector3d& high() const noexcept { return high_; }  // below low() where there is none
  double tissue() const noexcept { return tissue_; }              // [m^3]

 private:
  double of(int i, int j, int k) const noexcept;

  Volume share_;
  Eigen::Vector3d low_, high_;
  double tissue_ = 0;
};

}  // namespace palpate
