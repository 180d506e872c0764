#pragma once
// One mode over one step of any length h, exact for a load that is linear in it. With q'' + c q' + omega^2 q = g:
//
//   q+ = a11 q + a12 w + c0 g + c1 g+,     w+ = a21 q + a22 w + d0 g + d1 g+
//
// All eight follow from three numbers: what a unit load held for h does, P and P', and what one that grows as t does, Q
// (Q' = P):
//
//   a12 = P',  a11 = 1 - omega^2 P,  a21 = -omega^2 P',  a22 = 1 - c P' - omega^2 P
//   c1 = Q / h,  d1 = P / h,  c0 = P - c1,  d0 = P' - d1
//
// P and Q come from their power series over a step that is short for the mode, which is then doubled: no case is apart,
// not omega = 0 nor strong damping.

namespace palpate::haptic {

struct ModeResponse {
  double a11 = 1, a12 = 0, a21 = 0, a22 = 1;
  double c0 = 0, c1 = 0, d0 = 0, d1 = 0;
};

/// @param stiffness, damping  omega^2 and c [1/s^2], [1/s]  @param h  > 0 [s]
ModeResponse mode_response(double stiffness, double damping, double h) noexcept;

}  // namespace palpate::haptic
