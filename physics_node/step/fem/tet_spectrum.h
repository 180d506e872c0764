#pragma once
// The fastest vibration of a body of tetrahedra near rest.

#include "physics_node/body/tet_model.h"
#include "physics_node/step/lattice/stable_step.h"

namespace palpate::physics {

/// The bound that needs no iteration: no body vibrates faster than its fastest tetrahedron would alone, S as in TetSharpness,
///   w^2 <= c / density (lambda trace S + 2 mu largest eigenvalue of S)
/// c is 4; of second order the largest eigenvalue of sum over points of A^T A / 4 over the shares of mass, where A makes w of u: 45.6.
/// Of nodal pressure it is a bound, too, since an average swells by no more than what it averages. A sliver decides: of cubes
/// in six it allows 0.66 of the step that is stable, of jittered ones a third.
double fastest_element(const TetModel& model);

/// Largest squared frequency and damping rate near rest, of the body as it is: the smaller of that bound and what Lanczos finds with
/// the forces of the kernel itself.
/// Cost: at most 60 sweeps over the tetrahedra, in double.
StiffestMode stiffest_mode_of_tetrahedra(const TetModel& model);

/// The bound alone, which holds whatever faces are opened: parts of a body vibrate no faster than its fastest tetrahedron alone.
StiffestMode stiffest_mode_when_cut(const TetModel& model);

}  // namespace palpate::physics
