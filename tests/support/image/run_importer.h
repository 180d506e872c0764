#pragma once
// Runs palpate-import as a person would.

#include <string>
#include <vector>

namespace palpate::test {

struct Outcome {
  int code = -1;    // exit code; -1: it was killed
  std::string out;  // what it printed
  std::string err;  // and on stderr
};

Outcome run_importer(const std::vector<std::string>& arguments);

}  // namespace palpate::test
