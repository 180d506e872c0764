#pragma once
// What one sample of each topic costs the processor, at both ends together.

#include <optional>
#include <string>
#include <vector>

#include "bench/wire/two_ends.h"

namespace palpate::bench {

struct TopicCost {
  std::string topic;
  double write_us = 0;  // processor time of the writing process a sample
  double read_us = 0;   // and of one reading process
  double arrived = 0;   // share of the samples
};

/// Samples as full as they get, one each millisecond. @return those topics whose ends met
std::vector<TopicCost> measure_topics(Path path, int samples);

}  // namespace palpate::bench
