#include "render_node/view/way_scale.h"

#include <fmt/format.h>

#include <cmath>

#include "common/math/units.h"

namespace palpate::render {

void WayScale::see(double way) noexcept {
  if (!(way > most_) || !std::isfinite(way)) return;
  const double ten = std::pow(10, std::floor(std::log10(way)));
  for (const double times : {1.0, 2.0, 5.0, 10.0})
    if (way <= times * ten) {
      most_ = times * ten;
      return;
    }
}

std::string WayScale::words() const { return fmt::format("{:g} mm", mm_from_m(most_)); }

}  // namespace palpate::render
