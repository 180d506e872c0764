// A box or a ball in the world, and the cavities of a body.
#include <fmt/format.h>

#include "common/scene/body_spec.h"
#include "common/scene/read_parts.h"

namespace palpate {
namespace {

constexpr std::size_t most_cavities = 64;
constexpr std::string_view places = "give box_min_mm and box_max_mm, or center_mm and radius_mm";

void read_cavity(const toml::table& table, TableReader& body, ReadContext& context, BodySpec& spec) {
  TableReader reader(table, fmt::format("cavity of {}", body.title()), context.complaints);
  CavitySpec cavity;
  cavity.place = reader.place();
  const bool box = reader.has("box_min_mm") || reader.has("box_max_mm");
  const bool ball = reader.has("center_mm") || reader.has("radius_mm");
  if (!box && !ball) reader.complain_lack("a place", places);
  if (box && ball)
    reader.complain_at(reader.place(), fmt::format("{} has 2 places; {}", reader.title(), places));
  if (box) cavity.where = read_box_place(reader);
  if (ball) cavity.where = read_ball_place(reader);
  reader.allow({"box_min_mm", "box_max_mm", "center_mm", "radius_mm"});
  reader.refuse_left_over();
  spec.cavities.push_back(cavity);
}

}  // namespace

BoxRegion read_box_place(TableReader& reader) {
  reader.require("box_min_mm", "give the lowest corner of the box as [x, y, z]");
  reader.require("box_max_mm", "give the highest corner of the box as [x, y, z]");
  BoxRegion box;
  const auto min = reader.read_vector_mm("box_min_mm");
  const auto max = reader.read_vector_mm("box_max_mm");
  set_if(box.min, min);
  set_if(box.max, max);
  if (min && max && (min->array() > max->array()).any())
    reader.complain("box_max_mm", "\"box_max_mm\" lies below \"box_min_mm\"; swap the corners of the box");
  return box;
}

BallRegion read_ball_place(TableReader& reader) {
  reader.require("center_mm", "give the middle of the ball as [x, y, z]");
  reader.require("radius_mm", "give the radius of the ball");
  BallRegion ball;
  set_if(ball.center, reader.read_vector_mm("center_mm"));
  set_if(ball.radius, reader.read_length_mm("radius_mm"));
  return ball;
}

void read_cavities(TableReader& body, ReadContext& context, BodySpec& spec) {
  const auto form = fmt::format("a table under [[body.cavity]]; {}", places);
  const auto* list = body.read_array("cavity", form);
  if (list == nullptr) return;
  if (list->size() > most_cavities) {
    body.complain("cavity",
                  fmt::format("{} cavities in {}; at most {}", list->size(), body.title(), most_cavities));
    return;
  }
  for (const auto& item : *list) {
    if (item.is_table())
      read_cavity(*item.as_table(), body, context, spec);
    else
      body.complain_value("cavity", item, form);
  }
}

}  // namespace palpate
