#pragma once
// Where something stands in a scene file.

#include <string>

namespace palpate {

/// Where something stands in the scene file, for messages: "file:line:column".
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
  std::string text() const;
};

}  // namespace palpate
