#pragma once
// What strands between two bodies are made of, and where they begin and end.
//
//   F = (k (l - L) + c dl/dt) u where l > L, and never pushes;  k = E A / L,  c = eta A / L
// A is the area of the first surface that a strand stands for.
// A strand tears for good where it holds as much as its area is tough for: k (l - L)^2 / 2 = G_c A.

#include <array>
#include <vector>

#include "common/scene/connection_spec.h"
#include "physics_node/boundary/surface.h"

namespace palpate::physics {

struct Strand {
  Index node = 0;                 // of the first body
  std::array<Index, 3> foot{};    // nodes of the second
  std::array<double, 3> share{};  // of the foot's place: at least 0, 1 in all
  double area = 0;                // a third of the triangles around its node, as much as shows along it [m^2]
  double length = 0;              // at rest [m]
  double k = 0;                   // [N/m]
  double c = 0;                   // [N s/m]
  double most_longer = 0;         // at which it tears; infinite: never [m]
  double cut_work = 0;            // that a blade takes to cut it: G_c A of a cut; 0: nobody has said [J]
};

/// A force on a strand, which its ends carry by how near they are.
struct StrandPush {
  std::size_t strand = 0;
  double at = 0;              // share of the way from its node to its foot
  Vec3 force = Vec3::Zero();  // [N]
  double cuts = 0;            // share of the strand that this cuts
};

/// From every moving vertex of `from` to the nearest place on moving facets of `to`, where that is within reach. A
/// strand is no shorter at rest than a tenth of the reach: surfaces that touch are not joined by what is infinitely
/// stiff.
/// Cost: vertices times facets near them.
std::vector<Strand> make_strands(const ConnectionSpec& spec, const Surface& from, const Surface& to);

/// By how much the strands raise the largest squared frequency of a body, at most; see strands.cpp.
/// @param end  0: of the first body, 1: of the second  @param inverse_mass  by node
double added_omega2(const std::vector<Strand>& strands, int end, const std::vector<double>& inverse_mass);
/// And their dampers the largest rate 2 D = c / m that a velocity dies away by, at most [1/s].
double added_rate(const std::vector<Strand>& strands, int end, const std::vector<double>& inverse_mass);

}  // namespace palpate::physics
