#include "deploy/import/property_list.h"

#include <pugixml.hpp>
#include <string_view>

#include "common/error/error.h"

namespace palpate {
namespace {

constexpr int deepest = 16;  // nesting; InVesalius uses four levels

PropertyList value_of(const std::string& where, const pugi::xml_node& node, int depth) {
  if (depth > deepest)
    throw InputError(where + ": its property list is nested too deep; save it anew in InVesalius");
  PropertyList value;
  const std::string_view kind = node.name();
  if (kind == "dict") {
    for (auto key = node.child("key"); key; key = key.next_sibling("key"))
      value.entries[key.child_value()] = value_of(where, key.next_sibling(), depth + 1);
  } else if (kind == "array") {
    for (const auto& item : node.children()) value.items.push_back(value_of(where, item, depth + 1));
  } else {
    value.text = node.child_value();
  }
  return value;
}

}  // namespace

PropertyList parse_property_list(const std::string& where, const std::string& text) {
  pugi::xml_document document;
  const auto result = document.load_buffer(text.data(), text.size());
  const auto root = document.child("plist").child("dict");
  if (!result || !root)
    throw InputError(where + ": is not a property list (" + result.description() +
                     "); save it anew in InVesalius");
  return value_of(where, root, 0);
}

}  // namespace palpate
