// A hanging bar, `cells` cubic cells wide and twice as long, stretched by its weight: its Young's modulus, half a width
// above its free end, where it does not feel how it is held.
//
//   inside    from stress and strain of the middle half of the section there, all three ways:
//             s_aa = (1 / V) sum over masses and half their elements of f l n_a n_a;  e_aa from a straight line through u_a(x_a)
//             e_zz = s_zz / E - (nu / E) (s_xx + s_yy),   e_xx = s_xx / E - (nu / E) (s_yy + s_zz),  both solved for E
//   outside   E = (weight below) / (nominal section x e_zz)
//
// Surface masses have fewer neighbours but whole elements between them, so a surface layer is stiffer or softer than the
// section that it counts for: the outside one errs with the first power of the spacing.

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "bench/problems/lattice_statics.h"
#include "bench/problems/problems.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/scene.h"

namespace palpate::bench {
namespace {

using physics::Index;

struct Middle {
  double n = 0;                                                                   // masses
  Vec3 x = Vec3::Zero(), xx = Vec3::Zero(), u = Vec3::Zero(), xu = Vec3::Zero();  // sums, by axis
  Vec3 virial = Vec3::Zero();                                                     // of f l n_a n_a [J]
  double weight_below = 0;                                                        // [kg]

  Vec3 strain() const { return (n * xu - x.cwiseProduct(u)).cwiseQuotient(n * xx - x.cwiseProduct(x)); }
};

/// f l n_a n_a of all elements of a mass, half of each belonging to it.
Vec3 virial(const physics::Body& body, const std::vector<Index>& number, const Eigen::Matrix3Xd& u,
            Index cell) {
  const physics::Lattice& lattice = body.lattice;
  const auto& offset = lattice.offset[static_cast<std::size_t>(lattice.row_kind(cell))];
  const auto half = static_cast<std::size_t>(lattice.n_half);
  Vec3 sum = Vec3::Zero();
  for (std::size_t d = 0; d < 2 * half; ++d) {
    if ((lattice.mask[static_cast<std::size_t>(cell)] >> d & 1U) == 0) continue;
    const Vec3 x = lattice.rest_vector[d] + u.col(number[static_cast<std::size_t>(cell + offset[d])]) -
                   u.col(number[static_cast<std::size_t>(cell)]);
    const double l = x.norm();
    sum += 0.5 * body.law.k1[d % half] * (l - lattice.rest_length[d]) / l * x.cwiseAbs2();
  }
  return sum;
}

/// Young's modulus of which this is a state, loaded along z.
double young(const Vec3& stress, const Vec3& strain) {
  const double s = 0.5 * (stress.x() + stress.y()), e = 0.5 * (strain.x() + strain.y());
  Eigen::Matrix2d compliance;  // of 1 / E and nu / E
  compliance << stress.z(), -2 * s, s, -(s + stress.z());
  return 1 / compliance.inverse().row(0).dot(Eigen::Vector2d(strain.z(), e));
}

/// 1 for a mass within `reach` cells of the middle, a half on each face of that cube: whole cells, so that the two kinds of
/// masses of the voxel lattice count alike.
double weight(const Vec3& cells_away, double reach) {
  double w = 1;
  for (const double away : cells_away) {
    if (std::abs(away) > reach + 1e-6) return 0;
    if (std::abs(away) > reach - 1e-6) w *= 0.5;
  }
  return w;
}

}  // namespace

Modulus bar_modulus(LatticeKind lattice_kind, int cells) {
  constexpr double E = 10e3, width = 0.1, H = 2 * width, z_m = 0.5 * width;
  const double cell = width / cells;
  // A cubic cell of the face-centred lattice is sqrt(2) spacings wide.
  const double spacing = lattice_kind == LatticeKind::fcc ? cell / std::numbers::sqrt2 : cell;
  Scene scene = empty_scene();
  MaterialSpec& tissue = scene.materials[0];
  tissue.mass.reset(), tissue.k1.reset();
  tissue.density = 1000;
  tissue.modulus = E;
  BodySpec spec = box_body(lattice_kind, Vec3(width, width, H), spacing);
  spec.fixed_faces[5] = true;  // +z
  const physics::Body body = physics::build_body(spec, tissue);
  const Vec3 gravity(0, 0, -1e-3);  // strains of 1e-5: linear
  const Eigen::Matrix3Xd u = linear_equilibrium(body, gravity);

  std::vector<Index> number(static_cast<std::size_t>(body.lattice.n_cells()), -1);
  Index count = 0;
  for (const Index mass : body.lattice.masses) number[static_cast<std::size_t>(mass)] = count++;
  const double reach = 0.5 * cells - std::round(cells / 4.0);  // of the middle, in cells
  Middle middle;
  for (const Index mass : body.lattice.masses) {
    const Vec3 p = body.lattice.rest_position(mass);
    if (p.z() < z_m - 1e-6 * H) middle.weight_below += body.law.mass;
    if (std::abs(p.z() - z_m) < 1e-6 * H) middle.weight_below += 0.5 * body.law.mass;
    const double w = weight((p - Vec3(width / 2, width / 2, z_m)) / cell, reach);
    if (w == 0) continue;
    const Vec3 displacement = u.col(number[static_cast<std::size_t>(mass)]);
    middle.virial += w * virial(body, number, u, mass);
    middle.n += w, middle.x += w * p, middle.xx += w * p.cwiseAbs2();
    middle.u += w * displacement, middle.xu += w * p.cwiseProduct(displacement);
  }
  const Vec3 strain = middle.strain();
  const Vec3 stress = middle.virial / (middle.n * physics::volume_per_mass(body.lattice));
  const double outside = middle.weight_below * gravity.norm() / (width * width * strain.z());
  return {young(stress, strain) / E, outside / E, count};
}

}  // namespace palpate::bench
