#pragma once
// How much tissue strains, the stress or pressure in it, or whether it is stepped, at its nodes: what colours show.
//
//   E   = (H + H^T + H^T H) / 2                  Green's strain of the gradient H of the displacement
//   strain = sqrt(2/3 E':E'),  E' = E - tr E / 3  equivalent strain; of a bar of constant volume its engineering strain, when small
//   stress = sqrt(3/2 s':s'),  s = P F^T / J      von Mises' of Cauchy's stress, of the elastic law alone: without dampers and what relaxes
//   pressure = max(0, -tr s / 3)                  how hard it is pressed together; where it is pulled apart none
//
// H is the mean of the cells, or by volume of the tetrahedra of first order, around a node that live; of a cell in
// its middle. Strain is of whatever has cells or tetrahedra; stress and pressure of finite elements that do not yield;
// any body is awake or not.

#include <memory>
#include <optional>
#include <vector>

#include "common/scene/colour_kind.h"
#include "physics_node/boundary/cut_cells.h"
#include "physics_node/material/tensor.h"
#include "physics_node/step/body_model.h"

namespace palpate::physics {

class TissueField {
 public:
  /// Nothing where the body has no such field. @param moving  outlives it
  static std::unique_ptr<TissueField> of(const BodyModel& moving, ColourKind kind);

  /// At a node; 0 where nothing lives around it, or where it is inside out. Strain, [Pa], or 1: it is awake.
  /// Cost: eight cells.
  double at(Index node) const noexcept;

 private:
  TissueField(const BodyModel& moving, ColourKind kind);
  struct Around {
    Tensor<double> H{};
    double modulus = 0;  // mean Young's [Pa]
    bool any = false;
  };
  Around around_cells(Index node) const noexcept;
  Around around_tets(Index node) const noexcept;

  const BodyModel& moving_;
  ColourKind kind_;
  std::optional<CellsNow> cells_;
  // Of a mesh that is not cut: tetrahedra at node n are tet_[first_[n]] and on, before first_[n + 1].
  std::vector<std::size_t> first_;
  std::vector<Index> tet_;
};

}  // namespace palpate::physics
