#pragma once
// What contact costs beside the element kernel, in the same run.

#include <cstdint>
#include <string>
#include <vector>

namespace palpate::bench {

struct ContactCost {
  std::string name;
  std::int64_t candidates = 0;
  std::int64_t pairs = 0;  // listed, mean of the frames
  std::int64_t collisions = 0;
  double rebuilds_per_step = 0;
  double contact_us = 0;  // a step, with its share of what a frame begins with
  double kernel_us = 0;   // a step of the elements of all bodies
  std::int64_t masses = 0;
  std::int64_t skipped = 0;  // steps without contact
  std::int64_t steps = 0;

  /// Contact of 20,000 candidates over the elements of 100,000 masses.
  double ratio() const {
    return contact_us / static_cast<double>(candidates) * 20000 /
           (kernel_us / static_cast<double>(masses) * 100000);
  }
};

/// Two cubes that slide over each other, the same far apart, and a ball that is smashed: while it breaks and after.
std::vector<ContactCost> measure_contact_costs();

}  // namespace palpate::bench
