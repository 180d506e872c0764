#pragma once
// What a step must do at least for each mass: counted from the law, not from the machine code, so that a kernel that does
// less work for the same law looks better and one that does some twice does not.
//
//   per element  d = u_j - u_i 3, x = D + d 3, q = d . (x + D) 8, l^2 1, l 1, k1 q / (l^2 + L l) 4, s x 3,
//                added to both masses 6                                                                      29
//     damped     dv 3, dv . x 5, c and the common denominator 4                                              12
//     plastic    l - L 2, l_c 1, k1 1, l - y_p L 2, the plastic branch 3, choice 1, / l 1, instead of 4        7
//     yielding   yield reached? 1, l_c 2, y_p 1                                                              4
//   per mass     v + dt (f w + g), u + dt v                                                                 18
//
// A root or a division counts as one.

#include "bench/problems/cube.h"

namespace palpate::bench {

struct MassWork {
  double flops = 0;
  /// u and v read and written, inverse mass and mask read; with plasticity l_c and y_p read, and written while yielding.
  double bytes = 0;
};
MassWork work_per_mass(const CubeKind& kind, const physics::Body& body);

}  // namespace palpate::bench
