#pragma once
// What the surface of a body looks like to a stick that lies on it or is about to: one plane, smooth although facets are
// steps and masses are rows.
//
// Facet f has its centre at c_f, its normal n_f and its area A_f; a_f is the point of the stick's axis nearest to c_f, r its
// radius. Above f the stick is g_f high, beside it by l_f:
//
//   g_f = n_f . (a_f - c_f) - r,    w_f = A_f (1 - l_f^2 / R^2)^2 (1 - (g_f - g_min) / D)^2,    g = sum w g / sum w,
//   normal = sum w n / |sum w n|
//
// R is twice the stick's radius and two cells at least, D a quarter of a cell: the lowest part of a stick that leans counts.
// Source: Adamson & Alexa 2003 (surfaces from weighted averages), as for a point (tool_contact.h).

#include <vector>

#include "physics_node/boundary/boundary.h"
#include "physics_node/contact/stick_search.h"

namespace palpate::physics {

struct StickPlane {
  bool found = false;
  Vec3 normal = Vec3::UnitZ();  // out of the tissue, unit
  double gap = 0;               // of the stick above the plane, g; below 0: in it [m]
  double sunk = 0;              // of the facets since they were at rest, along -normal [m]
  double area = 0;              // sum of w [m^2]
  double along = 0;             // mean place of the facets on the stick's axis by w, 0: its tip, 1: its end
  double spread = 0;            // standard deviation of the same
  double held = 0;              // share of facets whose masses are all held, by w, 0..1
};

class StickSurface {
 public:
  /// @param surface, moving  outlive it. @param radius  of the stick [m]
  StickSurface(const Boundary& surface, const NodeMotion& moving, double radius);

  /// Looks for facets around the stick; keeps what it found until stick or tissue may have left it.
  void look(const Stick& stick, double t) noexcept;
  /// Under the stick, by the surface at rest or as it is now.
  StickPlane plane(const Stick& stick, bool at_rest) noexcept;

  const Body& body() const noexcept { return moving_.body(); }

 private:
  struct Facet {
    Vec3 centre, normal, rest;
    double area = 0, gap = 0, lateral = 0;  // l_f^2 / R^2
    double along = 0;                       // of a_f on the axis, 0..1
    bool held = false;
  };
  bool gives(std::uint32_t facet) const noexcept;
  void collect(const Stick& stick, bool at_rest) noexcept;

  const Boundary& surface_;
  const NodeMotion& moving_;
  double reach_, depth_;             // R, D [m]
  std::vector<std::uint32_t> near_;  // facets around the stick
  std::vector<Facet> facets_;        // those that it may touch
  StickSearch search_;
  std::uint64_t searched_revision_ = 0;  // of the boundary
};

}  // namespace palpate::physics
