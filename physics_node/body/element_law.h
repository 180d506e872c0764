#pragma once
// The law of all elements of a body, and how it follows from a material.
//
//   tension positive, l the length, L the rest length (EQUATIONS C-1 to C-6):
//     l / L <= y_p          f_s = k1 (l - L - l_c)
//     y_p < l / L <= b_p    f_s = k1 ((y_p - 1) L - l_c) + k2 (l - y_p L); then y_p := l / L, l_c := l - L - f_s / k1
//     l / L > b_p           the element is gone for good
//     f = f_s + c l'        on mass i toward mass j
//
// A material may give instead of k1 the force per relative stretch: f_s = lambda (l - L) / L, so k1 = lambda / L by
// direction; and a drag b of each mass, f_i = ... - b v_i (Mendoza & Laugier; EQUATIONS C-20, C-21, C-23).
//
// Source: Wakamatsu & Honma 2011, eqs. (1) to (3).
// Deviation: the paper prints - c l', which feeds energy in; and leaves open which f enters l_c: the static one.

#include <Eigen/Core>
#include <array>

#include "common/math/vec3.h"
#include "common/scene/kinds.h"
#include "common/scene/scene_fwd.h"
#include "physics_node/lattice/lattice.h"

namespace palpate::physics {

struct ElementLaw {
  double mass = 0;                    // of every mass [kg]
  std::array<double, max_half> k1{};  // by half direction [N/m]
  std::array<double, max_half> c{};   // by half direction [N s/m]
  double k2_ratio = 1;                // k2 / k1
  Damper damper = Damper::axial;      // how c acts; one kind in a body
  double drag = 0;                    // b of every mass: f_i -= b v_i [N s/m]
  double y_p = 0;                     // yield ratio, for materials that yield
  double b_p = 0;                     // break ratio
  bool damped = false;                // any c > 0; says nothing of the drag
  bool yields = false;
  double cut_toughness = 0;     // what a blade pays by area; 0: not stated [J/m^2]
  double puncture_ratio = 1.5;  // by how much a tip has to press harder until it enters
  double modulus = 0;           // mean Young's modulus along the axes [Pa]
};

/// Stiffness of the homogenised lattice, in its own axes, in Voigt order xx yy zz yz xz xy (engineering shear) [Pa]:
///   C_ijkl = (1/V) sum over half directions of e k L^2 n_i n_j n_k n_l,   V the volume of a mass, e its elements_per_mass.
Eigen::Matrix<double, 6, 6> homogenised_stiffness(const Lattice& lattice,
                                                  const std::array<double, max_half>& k1);

/// Volume that one whole mass stands for [m^3].
double volume_per_mass(const Lattice& lattice);

/// Mean of Young's moduli along x, y and z of the stiffness given, so of a lattice whichever way it is turned [Pa].
double axial_modulus(const Eigen::Matrix<double, 6, 6>& stiffness);

/// Spring constants, damping and mass from a material. A modulus is met by the mean axial modulus of the lattice;
/// the mass is that of a whole mass deep inside.
ElementLaw element_law(const Lattice& lattice, const MaterialSpec& material);

}  // namespace palpate::physics
