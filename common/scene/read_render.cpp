// [render] and [record]: what is seen and what is kept.
#include "common/math/units.h"
#include "common/scene/read_parts.h"
#include "common/scene/record_spec.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"

namespace palpate {
namespace {

void read_camera(TableReader& render, ReadContext& context) {
  const auto* table = render.read_table("camera");
  if (table == nullptr) return;
  TableReader reader(*table, "camera of [render]", context.complaints);
  auto& camera = context.scene.render->camera;
  if (const auto yaw = reader.read_number("yaw_deg", {.lo = -360, .hi = 360}))
    camera.yaw = rad_from_deg(*yaw);
  if (const auto pitch = reader.read_number("pitch_deg", {.lo = -90, .hi = 90}))
    camera.pitch = rad_from_deg(*pitch);
  camera.distance = reader.read_length_mm("distance_mm");
  camera.target = reader.read_vector_mm("target_mm");
  if (const auto field = reader.read_number("field_of_view_deg", {.lo = 1, .hi = 170}))
    camera.field_of_view = rad_from_deg(*field);
  reader.refuse_left_over();
}

void read_section(TableReader& render, ReadContext& context) {
  const auto* table = render.read_table("section");
  if (table == nullptr) return;
  TableReader reader(*table, "section of [render]", context.complaints);
  reader.require("axis", "write the axis that it lies across: \"x\", \"y\" or \"z\"");
  reader.require("at_mm", "write where on that axis it lies");
  SectionSpec section;
  if (const auto axis = reader.read_word("axis", {"x", "y", "z"})) section.axis = static_cast<int>(*axis);
  if (const auto at = reader.read_number("at_mm", {.lo = -1e6, .hi = 1e6})) section.at = m_from_mm(*at);
  context.scene.render->section = section;
  reader.refuse_left_over();
}

}  // namespace

void read_render(TableReader& root, ReadContext& context) {
  const auto* table = root.read_table("render");
  if (table == nullptr) return;
  TableReader reader(*table, "[render]", context.complaints);
  auto& render = *context.scene.render;
  if (const auto size = reader.read_integers("size_px", 2, "[width, height]", 16, 8192))
    render.size_px = {(*size)[0], (*size)[1]};
  read_camera(reader, context);
  read_section(reader, context);
  render.threshold = reader.read_number("threshold");
  render.inside = reader.read_number("inside");
  set_if(render.opacity, reader.read_number("opacity", {.lo = 0.05, .hi = 1}));
  if (const auto shown =
          reader.read_words("show", {"tool", "force", "panels", "wire", "fragments", "displacement", "strain",
                                     "stress", "pressure", "awake"})) {
    render.show_tool = (*shown)[0];
    render.show_force = (*shown)[1];
    render.show_panels = (*shown)[2];
    render.show_wire = (*shown)[3];
    render.show_fragments = (*shown)[4];
    int kinds = 0;
    for (std::size_t n = 1; n < colour_names.size(); ++n)
      if ((*shown)[4 + n]) render.colour = static_cast<ColourKind>(n), ++kinds;
    if (kinds > 1)
      reader.complain("show",
                      "\"displacement\", \"strain\", \"stress\", \"pressure\" and \"awake\" in \"show\" are "
                      "colours of the same tissue; name one of them");
  }
  set_if(render.rate_Hz, reader.read_number("rate_Hz", {.lo = 0, .hi = 1000, .without_lo = true}));
  if (const auto most = reader.read_integer("most_frames", 2, 1'000'000))
    render.most_frames = static_cast<int>(*most);
  if (const auto most = reader.read_number("most_frames_MB", {.lo = 1, .hi = 1e6}))
    render.most_frame_bytes = 1e6 * *most;
  reader.refuse_left_over();
}

void read_record(TableReader& root, ReadContext& context) {
  const auto* table = root.read_table("record");
  if (table == nullptr) return;
  TableReader reader(*table, "[record]", context.complaints);
  auto& record = *context.scene.record;
  if (const auto kept = reader.read_words("what", {"positions", "forces", "energy"})) {
    record.positions = (*kept)[0];
    record.forces = (*kept)[1];
    record.energy = (*kept)[2];
  }
  set_if(record.rate_Hz, reader.read_number("rate_Hz", {.lo = 0, .hi = 20000, .without_lo = true}));
  reader.refuse_left_over();
}

}  // namespace palpate
