#include "deploy/import/itk_volume.h"

#include "common/error/error.h"
#include "common/math/units.h"
#include "common/record/volume_check.h"
#include "deploy/import/memory_budget.h"

namespace palpate {
namespace {

// Why: a cell in the file's own type (8), ITK's and ours (4 each), and what a reader inflates from (8).
constexpr double itk_bytes = 24;

using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

void check_three_axes(const std::string& path, const ItkHeader& header) {
  bool three = header.size.size() >= 3;
  for (std::size_t axis = 3; axis < header.size.size(); ++axis) three &= header.size[axis] == 1;
  if (!three) throw InputError(path + ": is not three-dimensional; one image of three axes is wanted");
  if (header.components != 1)
    throw InputError(path + ": has several values a cell, such as colours; one is wanted");
}

}  // namespace

Volume itk_volume(const std::string& path, ItkFormat format) {
  Volume volume;
  // All of the header is checked before ITK takes memory for the cells.
  volume.intensity = read_itk(path, format, [&](const ItkHeader& header) {
    check_three_axes(path, header);
    volume.size = check_size(path, {header.size[0], header.size[1], header.size[2]});
    volume.spacing = Eigen::Vector3d(header.spacing_mm.data()) * m_from_mm(1);
    check_spacing(path, volume.spacing);
    volume.origin = Eigen::Vector3d(header.origin_mm.data()) * m_from_mm(1);
    const Eigen::Matrix3d direction = Eigen::Map<const Rows>(header.direction.data());
    const Eigen::Matrix3d skew = direction.transpose() * direction - Eigen::Matrix3d::Identity();
    if (!volume.origin.allFinite() || !(skew.cwiseAbs().maxCoeff() < 0.01))
      throw InputError(path + ": its axes are not at right angles; resample it onto a straight grid first");
    volume.orientation = direction;
    declare_cells(path, volume.n_cells(), itk_bytes);
  });
  return volume;
}

}  // namespace palpate
