#pragma once
// What a library fills in silently where a header is poor: looked up in the header itself.

#include <string>

namespace palpate {

struct ImageFacts {
  bool oriented = false;  // the header gives patient directions
  std::string data_file;  // where the cells are; empty: in the file itself
};

}  // namespace palpate
