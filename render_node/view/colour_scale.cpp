#include "render_node/view/colour_scale.h"

#include <fmt/format.h>

#include <cmath>

#include "common/math/units.h"

namespace palpate::render {

void ColourScale::see(double value) noexcept {
  value *= 1 - 1e-6;  // Why: a round number comes as a float
  if (!(value > most_) || !std::isfinite(value)) return;
  const double ten = std::pow(10, std::floor(std::log10(value)));
  for (const double times : {1.0, 2.0, 5.0, 10.0})
    if (value <= times * ten) {
      most_ = times * ten;
      return;
    }
}

void ColourScale::show(ColourKind kind) noexcept {
  if (kind == kind_) return;
  kind_ = kind;
  most_ = least[static_cast<std::size_t>(kind)];
}

std::string ColourScale::words() const {
  if (kind_ == ColourKind::awake) return "awake";
  if (kind_ == ColourKind::strain) return fmt::format("{:g} %", 100 * most_);
  if (is_of_physics(kind_)) return fmt::format("{:g} kPa", 1e-3 * most_);
  return fmt::format("{:g} mm", mm_from_m(most_));
}

const char* ColourScale::heading() const {
  return kind_ == ColourKind::strain     ? "strain"
         : kind_ == ColourKind::stress   ? "stress (von Mises)"
         : kind_ == ColourKind::pressure ? "pressure"
         : kind_ == ColourKind::awake    ? "what is stepped"
                                         : "from rest";
}

}  // namespace palpate::render
