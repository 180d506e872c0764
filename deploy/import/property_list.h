#pragma once
// The one door to pugixml: Apple's XML property lists, as InVesalius writes them.

#include <map>
#include <string>
#include <vector>

namespace palpate {

/// One value: a dictionary, a list, or the text of a number or a string.
struct PropertyList {
  std::map<std::string, PropertyList> entries;
  std::vector<PropertyList> items;
  std::string text;
};

/// @throws InputError beginning with `where`: not XML, not a property list, nested too deep
PropertyList parse_property_list(const std::string& where, const std::string& text);

}  // namespace palpate
