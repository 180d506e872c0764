#include "common/scene/material_spec.h"

namespace palpate {

std::string beyond_elastic(const MaterialSpec& material) {
  if (!material.relaxation.empty()) return "relaxes";
  if (material.law == TissueLaw::green) return "has law = \"green\"";
  if (material.yield_ratio) return "yields";
  if (material.break_ratio) return "breaks";
  return {};
}

}  // namespace palpate
