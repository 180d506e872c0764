#include "render_node/view/arrow_scale.h"

#include <cmath>

namespace palpate::render {

double arrow_metres_per_newton(double newton, double metres) {
  const double wish = metres / newton * (1 + 1e-9);
  const double decade = std::pow(10.0, std::floor(std::log10(wish)));
  if (wish >= 5 * decade) return 5 * decade;
  return wish >= 2 * decade ? 2 * decade : decade;
}

}  // namespace palpate::render
