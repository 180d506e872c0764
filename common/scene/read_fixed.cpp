// `fixed` of a body: faces of the shape and boxes in the world whose masses are held; and `handle`, faces that a hand moves.
#include <fmt/format.h>

#include <algorithm>

#include "common/scene/body_spec.h"
#include "common/scene/read_parts.h"

namespace palpate {
namespace {

constexpr std::array<std::string_view, 6> faces = {"-x", "+x", "-y", "+y", "-z", "+z"};
constexpr std::string_view fixed_form =
    R"("-x", "+x", "-y", "+y", "-z", "+z" or a box { min_mm = [x, y, z], max_mm = [x, y, z] })";

void read_fixed_box(const toml::table& table, TableReader& body, ReadContext& context, BodySpec& spec) {
  TableReader reader(table, fmt::format("fixed of {}", body.title()), context.complaints);
  reader.require("min_mm", "give the lowest corner of the box as [x, y, z]");
  reader.require("max_mm", "give the highest corner of the box as [x, y, z]");
  const auto min = reader.read_vector_mm("min_mm");
  const auto max = reader.read_vector_mm("max_mm");
  if (min && max) {
    if ((min->array() > max->array()).any())
      reader.complain("max_mm", "\"max_mm\" lies below \"min_mm\"; swap the corners of the box");
    spec.fixed_boxes.push_back({*min, *max});
  }
  reader.refuse_left_over();
}

}  // namespace

void read_fixed(TableReader& body, ReadContext& context, BodySpec& spec) {
  const auto* list = body.read_array("fixed", fmt::format("a list of {}", fixed_form));
  if (list == nullptr) return;
  for (const auto& item : *list) {
    const auto word = item.value_or(std::string());
    const auto face = std::find(faces.begin(), faces.end(), word);
    if (item.is_table())
      read_fixed_box(*item.as_table(), body, context, spec);
    else if (face != faces.end())
      spec.fixed_faces[static_cast<std::size_t>(face - faces.begin())] = true;
    else
      body.complain_value("fixed", item, fixed_form);
  }
}

void read_handle(TableReader& body, BodySpec& spec) {
  const auto chosen = body.read_words("handle", {faces.begin(), faces.end()});
  if (!chosen) return;
  std::copy(chosen->begin(), chosen->end(), spec.handle_faces.begin());
}

}  // namespace palpate
