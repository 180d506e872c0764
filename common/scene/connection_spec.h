#pragma once
// [[connection]]: tissue that joins two bodies.

#include <optional>
#include <string>

#include "common/scene/place.h"

namespace palpate {

/// Strands from the nodes of one body's surface to the nearest place on the other's, where that is near.
struct ConnectionSpec {
  std::string name;
  std::string from, to;  // bodies
  double within = 0;     // how far apart the surfaces are at most, where they are joined [m]
  double modulus = 0;    // Young's, along the strands [Pa]
  double viscosity = 0;  // of dampers beside them; 0: none [Pa s]
  double toughness = 0;  // what it takes to tear, by area of the first surface; 0: it does not [J/m^2]
  std::optional<double> cut_toughness;  // and what it takes to cut [J/m^2]
  Place place;
};

}  // namespace palpate
