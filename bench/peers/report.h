#pragma once
// Tables, files and words about what was measured.

#include <nlohmann/json.hpp>
#include <optional>

#include "bench/machine/result_folder.h"
#include "bench/peers/measure.h"

namespace palpate::bench {

struct Results {
  DropResult drop;
  std::vector<Point> steps;
  std::vector<Agreement> agreement;
};

/// CPU time at equal error; nothing where that error is never reached.
struct Ratio {
  std::string peer;  // and method
  double error = 0;
  bool at_best = false;  // the error is the smallest that the peer reaches
  std::optional<double> peer_s;
  std::optional<double> single_s, double_s;  // of palpate
};

/// At fixed errors and at the best error of each peer. palpate is the faster of its integrators, on one thread.
std::vector<Ratio> ratios_at_equal_error(const DropResult& drop);

Table table_of(const Results& results);
nlohmann::json json_of(const Results& results, const std::vector<Peer>& peers);
void print(const Results& results, const std::vector<Peer>& peers);

}  // namespace palpate::bench
