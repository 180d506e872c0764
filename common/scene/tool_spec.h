#pragma once
// [[tool]] of a scene: what the hand holds.

#include <Eigen/Core>
#include <optional>
#include <string>

#include "common/math/vec3.h"
#include "common/scene/kinds.h"
#include "common/scene/place.h"
#include "common/scene/scissors_spec.h"

namespace palpate {

/// A point touches tissue by the plane under it; a body is one of the scene's, driven by masses that the
/// hand holds; cylinder, cone and box are rigid, and go up from the tip; a scalpel is an edge that goes up from its tip and
/// toward -x, and cuts; scissors point down, and cut where their blades cross; forceps hold what is around their tip; a
/// needle goes up from its tip, and pierces. (A needle that is not rigid is a body.)
enum class ToolShape { point, stick, body, cylinder, cone, box, scalpel, scissors, forceps, needle };

/// How a point presses: by the masses under it, as in the papers, or as a rigid sphere on sampled faces.
enum class PointContact { nodes, faces };

/// Do cells of this spacing follow a shape of this size? Why half: on cells of twice its radius a sphere presses within 10 % of Hertz's force; on
/// those of two and a half times it slips between the samples of a face.
inline bool follows_shape(double spacing, double size) noexcept { return size >= 0.5 * spacing; }

struct ToolSpec {
  std::string name;
  ToolShape shape = ToolShape::point;
  std::string body;               // name of the body that it is; only ToolShape::body
  std::string device;             // name of a [device.NAME]
  Vec3 set_point = Vec3::Zero();  // moments are about this point [m]
  double low_pass_Hz = 20;        // of the force and moment that a body reports
  double radius =
      0.003;  // of the tip; of PointContact::nodes, its force fades out over twice that; of jaws [m]
  std::optional<PointContact> contact;  // of a point; absent: faces on finite elements, else nodes
  double stiffness = 400;               // of the contact spring between hand and proxy [N/m]
  double damping = 1.0;                 // [N s/m]
  double friction = 0;                  // Coulomb's coefficient between tip and surface
  double torque_limit = 0.1;            // [N m]
  /// Of the hand between two answers of physics, as the scene has it; who goes by it asks force_model.h.
  std::optional<ForceModel> force_model;
  ForceModel own_model = ForceModel::norton;  // of a point, where the scene has none: settle_force_models()
  double length = 0.1;  // from tip to end [m]; of a stick, cylinder, cone, needle, of the edge of a scalpel
  double shaft_friction = 0;  // of a needle, by its length in tissue [N/m]
  double edge = 0;            // of a scalpel: between its edge and the handle [rad]
  double grip = 2;            // of forceps: pull at which tissue slips from between the jaws [N]
  Vec3 size = Vec3::Zero();   // of a box [m]
  ScissorsSpec scissors;      // of scissors
  /// Where the handle is not turned; of all but points and bodies.
  Eigen::Matrix3d attitude = Eigen::Matrix3d::Identity();
  Place place;
};
/// Has it a rigid shape that only force_model = "tissue" presses?
inline bool is_solid_tip(ToolShape shape) noexcept {
  return shape == ToolShape::cylinder || shape == ToolShape::cone || shape == ToolShape::box;
}
/// Has it no proxy on a surface, so that the hand feels nothing but a wrench and its slope?
inline bool feels_slope(ToolShape shape) noexcept {
  return shape == ToolShape::scalpel || shape == ToolShape::scissors || shape == ToolShape::forceps ||
         shape == ToolShape::needle;
}
/// Does it part what it goes through?
inline bool cuts(const ToolSpec& tool) noexcept {
  return tool.shape == ToolShape::scalpel || tool.shape == ToolShape::scissors;
}
/// Does it meet the facets of bodies? One that is a body has masses of its own, which collide.
inline bool meets_facets(const ToolSpec& tool) { return tool.shape != ToolShape::body; }

/// Does a point press the faces of a body, as far as the scene says? Finite elements have a surface, whose faces bear; a spring's masses are
/// all that there is of it, as the papers have them. A hand's motion presses faces whatever they are of.
inline bool asks_for_faces(const ToolSpec& tool, bool of_finite_elements) noexcept {
  return tool.force_model.value_or(tool.own_model) == ForceModel::tissue || is_solid_tip(tool.shape) ||
         tool.contact.value_or(of_finite_elements ? PointContact::faces : PointContact::nodes) ==
             PointContact::faces;
}

}  // namespace palpate
