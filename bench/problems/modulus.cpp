// A hanging bar, `cells` cubic cells wide and twice as long, stretched by its weight: its Young's modulus, half a width
// above its free end, where it does not feel how it is held.
//
//   inside    E = s_zz / e_zz there, in the middle half of the section: s from the elements of the masses there,
//             s_ab = (1 / 2V) sum over masses and their elements of f l n_a n_b;  e_zz from a straight line through u_z(z)
//   outside   E = (weight below) / (nominal section x e_zz)
//
// Surface masses have half the neighbours but whole elements between them, so the outside one feels the surface layer
// directly, the inside one only through the bar's contraction. Both err with the first power of the spacing.

#include <cmath>
#include <numbers>

#include "bench/problems/lattice_statics.h"
#include "bench/problems/problems.h"

namespace palpate::bench {
namespace {

using physics::Index;

struct Middle {
  double stress = 0;  // sum of f l n_z n_z over all elements of the masses here
  double n = 0, z = 0, zz = 0, u = 0, zu = 0;
  double weight_below = 0;  // [kg]
};

/// f l n_z n_z of all elements of a mass, half of each belonging to it.
double axial_virial(const physics::Body& body, const std::vector<Index>& number, const Eigen::Matrix3Xd& u,
                    Index cell) {
  const physics::Lattice& lattice = body.lattice;
  const auto half = static_cast<std::size_t>(lattice.n_half);
  double sum = 0;
  for (std::size_t d = 0; d < 2 * half; ++d) {
    if ((lattice.mask[static_cast<std::size_t>(cell)] >> d & 1U) == 0) continue;
    const Index other = cell + lattice.offset[static_cast<std::size_t>(lattice.row_kind(cell))][d];
    const Vec3 x = lattice.rest_vector[d] + u.col(number[static_cast<std::size_t>(other)]) -
                   u.col(number[static_cast<std::size_t>(cell)]);
    const double l = x.norm();
    sum += 0.5 * body.law.k1[d % half] * (l - lattice.rest_length[d]) * x.z() * x.z() / l;
  }
  return sum;
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
    const double u_z = u(2, number[static_cast<std::size_t>(mass)]);
    middle.stress += w * axial_virial(body, number, u, mass);
    middle.n += w, middle.z += w * p.z(), middle.zz += w * p.z() * p.z();
    middle.u += w * u_z, middle.zu += w * p.z() * u_z;
  }
  const double strain =
      (middle.n * middle.zu - middle.z * middle.u) / (middle.n * middle.zz - middle.z * middle.z);
  const double stress = middle.stress / (middle.n * physics::volume_per_mass(body.lattice));
  return {stress / strain / E, middle.weight_below * gravity.norm() / (width * width * strain) / E, count};
}

}  // namespace palpate::bench
