// What of physics_node may know that a body is a lattice, and how wide an interface may be.
#include <regex>

#include "tests/house/house_rules.h"

namespace palpate::house {
namespace {

constexpr int most_virtual = 12;  // of a class, its destructor among them

/// Rooms that make, bound and step lattices.
bool knows_lattices(const std::string& path) {
  static const std::regex rooms("^physics_node/(lattice|body|boundary|step/lattice)/");
  return std::regex_search(path, rooms);
}

void look_for_fields(const SourceFile& file, std::vector<std::string>& breaches) {
  static const std::regex field("mask|offset\\[");
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    std::smatch match;
    if (std::regex_search(file.lines[i], match, field))
      breaches.push_back(file.path + ":" + std::to_string(i + 1) + ": \"" + match.str() +
                         "\" is of a lattice; ask Adjacency, TopologyEvents or the boundary");
  }
}

/// Classes are told apart by the lines that begin them: none is nested in another and virtual, too.
void count_virtual(const SourceFile& file, std::vector<std::string>& breaches) {
  static const std::regex begins("^(class|struct) (\\w+)"), member("^\\s*virtual\\b");
  std::string name;
  int n = 0;
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    std::smatch match;
    if (std::regex_search(file.lines[i], match, begins)) name = match[2], n = 0;
    if (std::regex_search(file.lines[i], member) && ++n == most_virtual + 1)
      breaches.push_back(file.path + ":" + std::to_string(i + 1) + ": " + name + " has more than " +
                         std::to_string(most_virtual) + " virtual members; split it by who uses them");
  }
}

}  // namespace

std::vector<std::string> seam_breaches(const SourceFile& file) {
  std::vector<std::string> breaches;
  if (!file.path.starts_with("physics_node/")) return breaches;
  if (!knows_lattices(file.path)) look_for_fields(file, breaches);
  count_virtual(file, breaches);
  return breaches;
}

}  // namespace palpate::house
