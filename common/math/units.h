#pragma once
// SI inside; these are the conversions at the doors (scene files, command lines, screens, CSV).

#include <numbers>

namespace palpate {

constexpr double m_from_mm(double mm) { return mm * 1e-3; }
constexpr double mm_from_m(double m) { return m * 1e3; }
constexpr double kg_from_g(double g) { return g * 1e-3; }
constexpr double Pa_from_kPa(double kPa) { return kPa * 1e3; }
constexpr double rad_from_deg(double deg) { return deg * (std::numbers::pi / 180.0); }
constexpr double deg_from_rad(double rad) { return rad * (180.0 / std::numbers::pi); }

}  // namespace palpate
