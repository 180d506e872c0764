#pragma once
// The slowest ways in which a body swings about its rest.

#include "physics_node/reduced/linear_answer.h"

namespace palpate::physics {

struct ModeTask {
  int n = 9;                // how many
  double tolerance = 1e-3;  // of a mode's residual, below
  int most_solves = 96;
};

/// K phi_i = omega_i^2 M phi_i,  phi_i^T M phi_j = 1 where i = j, else 0: the lowest, of a free body its rigid motions (omega 0) too.
struct VibrationModes {
  Eigen::VectorXd omega2;  // growing (n) [1/s^2]
  Eigen::MatrixXd shape;   // (3 n_rows, n) [kg^-1/2]
  double residual = 0;  // largest |(K + s M)^-1 M phi - phi / (omega^2 + s)| (omega^2 + s), in the norm of M
  int solves = 0;
  bool converged = false;  // all n to the tolerance
};

/// Block Krylov: vectors made by (K + s M)^-1 M from four that hold a bit of everything, kept M-orthogonal, and the best combinations of
/// all of them (Rayleigh, Ritz). Four at a time find modes that a symmetric body has twice. Of the lowest n modes the error of
/// omega^2 is of the order of the square of the residual.
/// Fewer than n where the body has fewer ways to move. Cost: some 40 solves, and 3 n_rows vectors as many. Allocates. The same bits on any number of threads.
VibrationModes lowest_modes(LinearAnswer& body, const ModeTask& task = {}, const Crew& crew = {});

}  // namespace palpate::physics
