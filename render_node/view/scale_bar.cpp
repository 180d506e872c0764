#include "render_node/view/scale_bar.h"

#include <fmt/format.h>

#include "common/math/units.h"
#include "render_node/view/arrow_scale.h"

namespace palpate::render {

ScaleBar scale_bar(const Camera& camera, double most_px) {
  const double px_per_m = camera.pixels_per_metre();
  const double metres =
      arrow_metres_per_newton(1.0, most_px / px_per_m);  // rounds down to 1, 2, 5 times 10^n
  return {metres, metres * px_per_m, fmt::format("{:g} mm", mm_from_m(metres))};
}

}  // namespace palpate::render
