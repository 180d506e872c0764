#pragma once
// What VTK sees in an export.

#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

namespace palpate::physics::test {

/// One entry a time, as open_export.py says it; null where VTK does not open it.
inline nlohmann::json seen_by_vtk(const std::string& pvd) {
  const char* source = std::getenv("PALPATE_SOURCE");
  const std::string script =
      std::string(source == nullptr ? "." : source) + "/tests/unit/physics_node/record/open_export.py";
  std::FILE* pipe = popen(("/usr/bin/python3 '" + script + "' '" + pvd + "'").c_str(), "r");
  std::string said;
  for (int letter = std::fgetc(pipe); letter != EOF; letter = std::fgetc(pipe))
    said += static_cast<char>(letter);
  if (pclose(pipe) != 0) return nullptr;
  return nlohmann::json::parse(said, nullptr, false);
}

}  // namespace palpate::physics::test
