// `shape` of a body and the keys that belong to it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/math/angles.h"
#include "common/math/units.h"
#include "common/scene/body_spec.h"
#include "common/scene/near_miss.h"
#include "common/scene/read_parts.h"

namespace palpate {
namespace {

const std::vector<std::string> shapes = {"sphere", "box",    "tube",   "knife",
                                         "needle", "volume", "slices", "mesh"};
const std::vector<std::string> keys_of_shapes = {
    "radius_mm", "size_mm",   "outer_radius_mm", "inner_radius_mm",  "wall_layers",
    "length_mm", "axis",      "height_mm",       "diameter_mm",      "theta_deg",
    "file",      "unit",      "files",           "pixel_mm",         "plane_mm",
    "keep",      "partition", "deformable",      "largest_component"};
constexpr int most_layers = 1000;
constexpr double bluntest_deg = 90, sharpest_deg = 5;  // angle of a bevel

SphereShape read_sphere(TableReader& body) {
  SphereShape sphere;
  body.require("radius_mm", "give the radius of the sphere");
  set_if(sphere.radius, body.read_length_mm("radius_mm"));
  return sphere;
}

BoxShape read_box(TableReader& body) {
  BoxShape box;
  body.require("size_mm", "give the edges of the box as [x, y, z]");
  set_if(box.size, body.read_vector_mm("size_mm", positive));
  return box;
}

/// inner_radius_mm or wall_layers.
void read_wall(TableReader& body, TubeShape& tube) {
  const auto inner = body.read_length_mm("inner_radius_mm", not_negative);
  set_if(tube.inner_radius, inner);
  if (inner && *inner >= tube.outer_radius && tube.outer_radius > 0)
    body.complain(
        "inner_radius_mm",
        fmt::format("\"inner_radius_mm\" in {} is {:g}; write a number below outer_radius_mm = {:g}",
                    body.title(), mm_from_m(*inner), mm_from_m(tube.outer_radius)));
  if (const auto layers = body.read_integer("wall_layers", 1, most_layers))
    tube.wall_layers = static_cast<int>(*layers);
  if (body.has("wall_layers") && body.has("inner_radius_mm"))
    body.complain("wall_layers", "both \"inner_radius_mm\" and \"wall_layers\" are given; keep one of them");
}

TubeShape read_tube(TableReader& body) {
  TubeShape tube;
  body.require("outer_radius_mm", "give the outer radius of the tube");
  body.require("length_mm", "give the length of the tube");
  set_if(tube.outer_radius, body.read_length_mm("outer_radius_mm"));
  read_wall(body, tube);
  set_if(tube.length, body.read_length_mm("length_mm"));
  if (const auto axis = body.read_word("axis", {"x", "y", "z"})) tube.axis = static_cast<int>(*axis);
  return tube;
}

KnifeShape read_knife(TableReader& body) {
  KnifeShape knife;
  body.require("length_mm", "give the length of the edge");
  body.require("height_mm", "give the height of the blade, from the edge to the back");
  set_if(knife.length, body.read_length_mm("length_mm"));
  set_if(knife.height, body.read_length_mm("height_mm"));
  return knife;
}

NeedleShape read_needle(TableReader& body) {
  NeedleShape needle;
  body.require("length_mm", "give the length of the needle, from the tip to the hub");
  body.require("diameter_mm", "give the outer diameter of the needle");
  body.require("theta_deg", "give [swing, twist, rotation, sharpening], the last between bevel and axis");
  set_if(needle.length, body.read_length_mm("length_mm"));
  set_if(needle.diameter, body.read_length_mm("diameter_mm"));
  return needle;
}

/// theta_deg about the tip or centre: three angles, and the sharpening of a needle.
void read_angles(TableReader& body, BodySpec& spec) {
  auto* needle = std::get_if<NeedleShape>(&spec.shape);
  const auto degrees = body.read_numbers(
      "theta_deg", needle != nullptr ? 4 : 3,
      needle != nullptr ? "[swing, twist, rotation, sharpening]" : "[tangential, twist, direction]");
  if (!degrees) return;
  const auto& t = *degrees;
  spec.orientation = rotation_of_angles({rad_from_deg(t[0]), rad_from_deg(t[1]), rad_from_deg(t[2])});
  if (needle == nullptr) return;
  needle->sharpening = rad_from_deg(t[3]);
  if (t[3] < sharpest_deg || t[3] > bluntest_deg)
    body.complain("theta_deg",
                  fmt::format("the sharpening angle in {} is {:g}; write a number from {:g} to {:g}",
                              body.title(), t[3], sharpest_deg, bluntest_deg));
}

}  // namespace

bool read_shape(TableReader& body, ReadContext& context, BodySpec& spec) {
  const auto* value = body.find("shape");
  const auto word = value == nullptr ? std::string() : value->value_or(std::string());
  if (word == "sphere") {
    spec.shape = read_sphere(body);
  } else if (word == "box") {
    spec.shape = read_box(body);
  } else if (word == "tube") {
    spec.shape = read_tube(body);
  } else if (word == "knife") {
    spec.shape = read_knife(body);
  } else if (word == "needle") {
    spec.shape = read_needle(body);
  } else if (word == "volume") {
    spec.shape = read_volume_shape(body, context);
  } else if (word == "slices") {
    spec.shape = read_slices_shape(body, context);
  } else if (word == "mesh") {
    spec.shape = read_mesh_shape(body, context);
  } else {
    body.allow(keys_of_shapes);  // whose they are cannot be told
    if (value == nullptr)
      body.complain_lack("\"shape\"", "write " + quoted_list(shapes));
    else
      body.complain_word("shape", *value, shapes);
    return false;
  }
  if (std::holds_alternative<VolumeShape>(spec.shape)) return true;
  read_angles(body, spec);
  // A knife is held at its back, a needle at its hub.
  spec.handle_faces[5] =
      std::holds_alternative<KnifeShape>(spec.shape) || std::holds_alternative<NeedleShape>(spec.shape);
  return true;
}

void refuse_small_tool(TableReader& body, const BodySpec& spec) {
  if (!spec.spacing) return;
  const double spacing = *spec.spacing, mm = mm_from_m(spacing);
  if (const auto* knife = std::get_if<KnifeShape>(&spec.shape)) {
    for (const auto& [key, size] :
         {std::pair("length_mm", knife->length), std::pair("height_mm", knife->height)})
      if (size > 0 && size < 2 * spacing)
        body.complain(
            key,
            fmt::format("\"{}\" in {} is {:g}; a blade is two cells or more, {:g} with spacing_mm = {:g}",
                        key, body.title(), mm_from_m(size), 2 * mm, mm));
  }
  const auto* needle = std::get_if<NeedleShape>(&spec.shape);
  if (needle == nullptr || needle->diameter <= 0) return;
  if (needle->diameter < 4 * spacing)
    body.complain(
        "diameter_mm",
        fmt::format("\"diameter_mm\" in {} is {:g}; a tube with a wall of one cell is four cells wide or "
                    "more, {:g} with spacing_mm = {:g}",
                    body.title(), mm_from_m(needle->diameter), 4 * mm, mm));
  const double shortest =
      needle->sharpening > 0 ? needle->diameter / std::tan(needle->sharpening) + 2 * spacing : 0;
  if (needle->length > 0 && needle->length < shortest)
    body.complain("length_mm",
                  fmt::format("\"length_mm\" in {} is {:g}; the bevel and two cells of shaft take {:.4g}",
                              body.title(), mm_from_m(needle->length), mm_from_m(shortest)));
}

}  // namespace palpate
