#include "common/scene/body_spec.h"

#include <algorithm>

namespace palpate {

bool has_material(const BodySpec& body, const std::string& material) {
  return body.material == material || std::ranges::any_of(body.regions, [&](const RegionSpec& region) {
           return region.material == material;
         });
}

}  // namespace palpate
