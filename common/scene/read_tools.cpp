// [[tool]]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/math/angles.h"
#include "common/math/units.h"
#include "common/message/messages.h"
#include "common/scene/body_spec.h"
#include "common/scene/device_spec.h"
#include "common/scene/force_model.h"
#include "common/scene/near_miss.h"
#include "common/scene/read_parts.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"

namespace palpate {
namespace {

const std::vector<std::string> tool_shapes = {"point",   "stick",    "cylinder", "cone",  "box",
                                              "scalpel", "scissors", "forceps",  "knife", "needle"};
constexpr Range friction_range{.lo = 0, .hi = 2};
const std::vector<std::string> point_contacts = {"nodes", "faces"};  // in the order of PointContact
const std::vector<std::string> force_models = {word_of(ForceModel::norton), word_of(ForceModel::tangent),
                                               word_of(ForceModel::raw_planes), word_of(ForceModel::direct),
                                               word_of(ForceModel::tissue)};

/// A knife or needle in the table of its tool, under the name of the tool.
void read_own_body(TableReader& reader, ReadContext& context, ToolSpec& spec) {
  const auto body = read_body(reader, context);
  spec.shape = ToolShape::body;
  spec.name = spec.body = body.name;
  context.scene.bodies.push_back(body);
  if (context.scene.bodies.size() > max_bodies)
    reader.complain("shape", fmt::format("too many bodies, those of tools included; at most {}", max_bodies));
}

std::optional<ToolShape> rigid_shape(const toml::node* word) {
  const std::string name = word == nullptr ? std::string() : word->value_or(std::string());
  if (name == "stick") return ToolShape::stick;
  if (name == "cylinder") return ToolShape::cylinder;
  if (name == "cone") return ToolShape::cone;
  if (name == "box") return ToolShape::box;
  if (name == "scalpel") return ToolShape::scalpel;
  if (name == "scissors") return ToolShape::scissors;
  if (name == "forceps") return ToolShape::forceps;
  if (name == "needle") return ToolShape::needle;
  return std::nullopt;
}

/// name, and shape = "point" or another, or body = NAME.
void read_other_shape(TableReader& reader, ToolSpec& spec) {
  reader.require("name", "give each tool a name of its own");
  set_if(spec.name, reader.read_name("name"));
  const auto* shape = reader.find("shape");
  const auto body = reader.read_text("body");
  if (body) {
    spec.shape = ToolShape::body;
    spec.body = *body;
  }
  if (shape != nullptr && reader.has("body"))
    reader.complain("body", "both \"shape\" and \"body\" are given; keep one of them");
  else if (const auto rigid = rigid_shape(shape))
    spec.shape = *rigid;
  else if (shape != nullptr && shape->value_or(std::string()) != "point")
    reader.complain_word("shape", *shape, tool_shapes, ", or body = the name of a [[body]] instead");
}

/// The body of a tool: there is one, a hand can hold it, and nobody else does.
const BodySpec* find_tool_body(TableReader& reader, const ReadContext& context, const ToolSpec& spec) {
  const auto& bodies = context.scene.bodies;
  const auto body =
      std::find_if(bodies.begin(), bodies.end(), [&](const BodySpec& b) { return b.name == spec.body; });
  if (body != bodies.end()) return &*body;
  if (!spec.body.empty())
    reader.complain("body", fmt::format("there is no [[body]] \"{}\"; {}", spec.body,
                                        advice(spec.body, names_of(bodies), "bodies in this scene")));
  return nullptr;
}

void check_tool_body(TableReader& reader, const ReadContext& context, const ToolSpec& spec,
                     const BodySpec& body) {
  for (const auto& other : context.scene.tools)
    if (other.shape == ToolShape::body && other.body == body.name)
      reader.complain("body",
                      fmt::format("body \"{}\" is tool \"{}\" already; give each tool a body of its own",
                                  body.name, other.name));
  const auto marked = [](const std::array<bool, 6>& six) {
    return std::count(six.begin(), six.end(), true) > 0;
  };
  if (!marked(body.handle_faces))
    reader.complain("body",
                    fmt::format("body \"{}\" has no handle; give it handle = [\"+z\"] or other faces that "
                                "move with the hand",
                                body.name));
  if (marked(body.fixed_faces) || !body.fixed_boxes.empty())
    reader.complain("body",
                    fmt::format("body \"{}\" is fixed; a tool moves, so leave \"fixed\" out", body.name));
  const auto& devices = context.scene.devices;
  const auto device = std::find_if(devices.begin(), devices.end(),
                                   [&](const DeviceSpec& d) { return d.name == spec.device; });
  if (device == devices.end() || device->driver != "simulated" || device->waypoints.empty()) return;
  constexpr double most = 1e-3;
  const Vec3 begin = device->waypoints.front().p * mm_from_m(1), tip = body.at * mm_from_m(1);
  if ((device->waypoints.front().p - body.at).norm() <= most) return;
  reader.complain(
      "device",
      fmt::format("the path of device \"{}\" begins at [{:g}, {:g}, {:g}], {:.3g} mm from the tip of "
                  "body \"{}\"; begin within 1 mm of its at_mm = [{:g}, {:g}, {:g}]",
                  device->name, begin.x(), begin.y(), begin.z(), (begin - tip).norm(), body.name, tip.x(),
                  tip.y(), tip.z()));
}

void read_attitude(TableReader& reader, ToolSpec& spec) {
  if (const auto degrees = reader.read_numbers("theta_deg", 3, "[about z, about y, about x]"))
    spec.attitude = rotation_of_angles(
        {rad_from_deg((*degrees)[0]), rad_from_deg((*degrees)[1]), rad_from_deg((*degrees)[2])});
}

/// All but the length of its edge.
void read_scalpel(TableReader& reader, ToolSpec& spec) {
  spec.edge = rad_from_deg(reader.read_number("edge_deg", {.lo = 0, .hi = 90}).value_or(30));
  read_attitude(reader, spec);
}

/// All but the length of their blades.
void read_scissors(TableReader& reader, ToolSpec& spec) {
  ScissorsSpec& blades = spec.scissors;
  blades.length = spec.length;
  blades.opening = rad_from_deg(reader.read_number("opening_deg", {.lo = 10, .hi = 120}).value_or(60));
  set_if(blades.offset, reader.read_length_mm("offset_mm"));
  set_if(blades.close_s, reader.read_number("close_s", {.lo = 0.05, .hi = 60}));
  set_if(blades.friction, reader.read_number("friction", friction_range));
  read_attitude(reader, spec);
  if (blades.offset < 0.01 * blades.length)
    reader.complain(
        "offset_mm",
        fmt::format("edges that pass the pivot by {:.4g} mm take any force at their tips; write at least "
                    "{:.4g}, a hundredth of length_mm",
                    mm_from_m(blades.offset), mm_from_m(0.01 * blades.length)));
  if (blades.open_crossing() > 0.9 * blades.closed_crossing())
    reader.complain(
        reader.has("offset_mm")     ? "offset_mm"
        : reader.has("opening_deg") ? "opening_deg"
                                    : "length_mm",
        fmt::format("blades of {:.4g} mm that are open by {:.4g} degrees cross within the last tenth of "
                    "them, as each edge passes "
                    "the pivot by {:.4g} mm; open them wider, or write offset_mm = {:.2g}",
                    mm_from_m(blades.length), deg_from_rad(blades.opening), mm_from_m(blades.offset),
                    mm_from_m(0.5 * blades.length * std::sin(0.5 * blades.opening))));
}

/// All but its length.
void read_needle(TableReader& reader, ToolSpec& spec) {
  reader.require("diameter_mm", "give the outer diameter of the needle, such as diameter_mm = 1.2");
  if (const auto diameter = reader.read_length_mm("diameter_mm")) spec.radius = 0.5 * *diameter;
  set_if(spec.shaft_friction, reader.read_number("friction_N_per_m", not_negative));
  read_attitude(reader, spec);
}

void read_forceps(TableReader& reader, ToolSpec& spec) {
  set_if(spec.radius, reader.read_length_mm("radius_mm"));
  set_if(spec.grip, reader.read_number("grip_N", positive));
}

/// Size and attitude of what is rigid and more than a point; the forces of a stick or body are low-passed.
void read_rigid(TableReader& reader, ToolSpec& spec) {
  if (spec.shape == ToolShape::box) {
    reader.require("size_mm", "give the edges of the box as [x, y, z]");
    set_if(spec.size, reader.read_vector_mm("size_mm", positive));
  } else {
    reader.require("length_mm", "give it a length, such as length_mm = 100");
    set_if(spec.length, reader.read_length_mm("length_mm"));
    if (spec.shape == ToolShape::scalpel) return read_scalpel(reader, spec);
    if (spec.shape == ToolShape::scissors) return read_scissors(reader, spec);
    if (spec.shape == ToolShape::needle) return read_needle(reader, spec);
    spec.radius = spec.shape == ToolShape::stick ? 0.002 : 0.003;
    set_if(spec.radius, reader.read_length_mm("radius_mm"));
  }
  if (spec.shape == ToolShape::stick) set_if(spec.low_pass_Hz, reader.read_number("low_pass_Hz", positive));
  set_if(spec.friction, reader.read_number("friction", friction_range));
  read_attitude(reader, spec);
}

/// What the hand feels between two answers of physics.
void read_force_model(TableReader& reader, ToolSpec& spec) {
  const auto word = reader.read_word("force_model", force_models);
  if (word) spec.force_model = static_cast<ForceModel>(*word);
  const ForceModel model = force_model_of(spec);
  if (spec.friction > 0 && model != ForceModel::norton && model != ForceModel::tissue)
    reader.complain(
        "friction",
        "friction is felt with force_model = \"norton\" or \"tissue\" only; leave one of the two out");
  if (model == ForceModel::tissue && spec.contact == PointContact::nodes)
    reader.complain("contact",
                    "force_model = \"tissue\" presses faces; write contact = \"faces\", or leave it out");
  if (!word || can_feel(spec.shape, *spec.force_model)) return;
  reader.complain(
      "force_model",
      spec.shape == ToolShape::point
          ? "a point feels planes; write \"norton\", \"tissue\", \"raw_planes\" or \"direct\""
      : spec.shape == ToolShape::stick
          ? "a stick is more than a point and feels a wrench; write \"tangent\", \"tissue\" or \"direct\""
      : spec.shape == ToolShape::scalpel
          ? "a scalpel feels what its edge takes; write \"tangent\", or leave it out"
      : spec.shape == ToolShape::scissors
          ? "scissors feel what pushes them out of tissue; write \"tangent\", or leave it out"
      : spec.shape == ToolShape::forceps ? "forceps feel what they pull; write \"tangent\", or leave it out"
      : spec.shape == ToolShape::needle
          ? "a rigid needle feels what it takes to go on; write \"tangent\", or leave it out"
      : is_solid_tip(spec.shape)
          ? "this tool feels a copy of tissue; write \"tissue\", or leave it out"
          : "this tool is more than a point and feels a wrench; write \"tangent\" or \"direct\"");
}

ToolSpec read_tool(TableReader& reader, ReadContext& context) {
  ToolSpec spec;
  spec.place = reader.place();
  const auto* shape = reader.find("shape");
  const auto word = shape == nullptr ? std::string() : shape->value_or(std::string());
  const bool may_be_body = word == "knife" || word == "needle";
  const bool rigid = may_be_body && reader.read_flag("rigid").value_or(false);
  if (rigid && word == "knife")
    reader.complain("rigid", "a knife is a body of elements; write shape = \"scalpel\" for a rigid edge");
  if (!reader.has("body") && may_be_body && !(rigid && word == "needle"))
    read_own_body(reader, context, spec);
  else
    read_other_shape(reader, spec);
  refuse_known_name(reader, spec.name, names_of(context.scene.tools));
  reader.require("device", "name a [device.NAME] of this scene");
  if (const auto device = reader.read_text("device")) {
    spec.device = *device;
    refuse_unknown_reference(reader, "device", *device, names_of(context.scene.devices));
  }
  set_if(spec.set_point, reader.read_vector_mm("set_point_mm"));
  if (spec.shape == ToolShape::body) {
    set_if(spec.low_pass_Hz, reader.read_number("low_pass_Hz", positive));
    if (const auto* body = find_tool_body(reader, context, spec))
      check_tool_body(reader, context, spec, *body);
  } else if (spec.shape == ToolShape::forceps) {
    read_forceps(reader, spec);
  } else if (spec.shape != ToolShape::point) {
    read_rigid(reader, spec);
  } else {
    set_if(spec.radius, reader.read_length_mm("radius_mm"));
    set_if(spec.friction, reader.read_number("friction", friction_range));
    if (const auto contact = reader.read_word("contact", point_contacts))
      spec.contact = static_cast<PointContact>(*contact);
  }
  read_force_model(reader, spec);
  set_if(spec.torque_limit, reader.read_number("torque_limit_N_m", positive));
  set_if(spec.stiffness, reader.read_number("stiffness_N_per_m", positive));
  set_if(spec.damping, reader.read_number("damping_N_s_per_m", not_negative));
  reader.refuse_left_over();
  return spec;
}

}  // namespace

void read_tools(TableReader& root, ReadContext& context) {
  for (const auto* table : tables_of_list(root, "tool", max_tools)) {
    TableReader reader(*table, list_title(*table, "tool"), context.complaints);
    context.scene.tools.push_back(read_tool(reader, context));
  }
}

}  // namespace palpate
