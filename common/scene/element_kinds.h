#pragma once
// What a body's elements are, apart from kinds.h: few read it.

namespace palpate {

/// springs: the papers' lattice of springs. fem: finite elements, hexahedra on a voxel lattice or the tetrahedra of a mesh.
/// surface: springs on the edges of the outer triangles of a mesh.
enum class ElementModel { springs, fem, surface };

/// What a finite element's stress follows: stable neo-Hookean, or St Venant-Kirchhoff, which is linear in Green's strain.
enum class TissueLaw { neo_hookean, green };

/// What keeps a cell of one point from bending for nothing.
enum class HourglassKind { physical, isotropic };

/// What tetrahedra of a mesh are: linear ones, the same with the average pressure of their nodes, or of second order with ten nodes.
enum class TetElements { plain, nodal_pressure, second_order };

/// whole: a cell is in the shape or not, by its centre. filled: those at its border are as stiff as the share of them that is in.
enum class BorderCells { whole, filled };

/// What is drawn and felt of a body of cells: their outer faces, or a smooth skin where the tissue ends between their
/// centres.
enum class SkinKind { bricks, smooth };

/// rest: as it is built, without stress. balanced: where it rests under its weight.
enum class StartKind { rest, balanced };

}  // namespace palpate
