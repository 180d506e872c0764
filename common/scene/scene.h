#pragma once
// A scene as plain data, in SI. One file serves all three nodes; each uses its part.
// Read by load_scene.h. What is absent in the file is absent here (std::optional) or has the default below.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace palpate {

using Vec3 = Eigen::Vector3d;

/// Where something stands in the scene file, for messages: "file:line:column".
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
  std::string text() const;
};

enum class Integrator { symplectic_euler, velocity_verlet, backward_euler };
enum class Precision { single_, double_ };

struct PhysicsSpec {
  Integrator integrator = Integrator::symplectic_euler;
  std::optional<double> step;  // [s]; absent: "auto", from the stiffness and mass present
  double safety = 0.8;         // fraction of the stable step that "auto" takes, (0, 1]
  Precision precision = Precision::single_;
  int threads = 0;             // 0: as many as pay
  double frame_Hz = 1000;      // one take of the tools and one patch per frame
  bool sleep = true;           // regions at rest are skipped until something moves them
  Place place;
};

/// How a damper of constant c acts on mass i of an element toward j (EQUATIONS C-31).
///   axial     c ((v_j - v_i) . u) u   along the element: sound                              P0
///   relative  c (v_j - v_i)           the whole vector: takes angular momentum away           P3
///   drag      -c v_i                  against the world: takes momentum away                  P2
enum class Damper { axial, relative, drag };

/// Either per mass and spring (the papers' way) or per volume (a tissue). Exactly one of each group is given.
struct MaterialSpec {
  std::string name;
  std::optional<double> mass;            // of one mass [kg]          | one of these
  std::optional<double> density;         // [kg/m^3]                  |
  std::optional<double> k1;              // of one element [N/m]      | one of these
  std::optional<double> modulus;         // Young's modulus [Pa]      |
  std::optional<double> lambda;          // force per stretch, k1 L of every element [N] |
  double k2_ratio = 1.0;                 // k2 / k1 in [0, 1]
  std::optional<double> viscosity;       // of one element [N s/m]    | at most one; none: no damper
  std::optional<double> viscosity_bulk;  // [Pa s]                    |
  Damper damper = Damper::axial;
  double drag = 0;                       // of every mass against the world, -b v [N s/m]
  std::optional<double> yield_ratio;     // y_p > 1 |  both or neither: purely elastic
  std::optional<double> break_ratio;     // b_p > y_p
  Place place;
};

struct SphereShape { double radius = 0; };
struct BoxShape { Vec3 size = Vec3::Zero(); };
struct TubeShape {
  double outer_radius = 0, inner_radius = 0, length = 0;
  int axis = 2;
  std::optional<int> wall_layers{};  // instead of inner_radius: masses (fcc) or cells (voxel) from the outside in
};
/// A plate one cell thick. Where all angles are 0 its edge runs from the tip along +x, the blade stands up along +z from
/// the edge, and its sides look to -y and +y.
struct KnifeShape { double length = 0, height = 0; };
/// A bevelled tube with a wall of one cell. Where all angles are 0 it points down: the shaft runs from the tip along +z, and
/// the opening of the bevel looks to +x.
struct NeedleShape {
  double length = 0, diameter = 0;  // diameter: outer
  double sharpening = 0;            // angle between the plane of the bevel and the axis, (0, pi/2] [rad]
};
struct DeformableRegion {
  bool all = true;                    // or the kept cells within radius_voxels (Chebyshev) of the centre
  std::array<int, 3> center_voxel{};  // in the partition used
  int radius_voxels = 10;
  bool gravity_center = false;        // centre: of gravity of all kept cells, not center_voxel
  std::optional<int> nearest{};       // instead of the radius: so many kept cells, the nearest to the centre
};
/// Pictures of parallel planes, the lowest first.
struct SliceStack {
  std::vector<std::string> files;  // PNG, found from the folder of the scene file
  Vec3 spacing = Vec3::Zero();     // of pixels along a row, of rows, of planes [m]
};
struct VolumeShape {
  std::string file;                               // found from the folder of the scene file
  std::optional<SliceStack> slices{};             // instead of the file
  double keep_min = 0, keep_max = 0;              // intensity window that is tissue, inclusive
  std::optional<std::array<int, 3>> partition;    // resample to nx, ny, nz cells; absent: as stored
  DeformableRegion deformable;
  bool largest_component = false;                 // keep only the largest 6-connected component
};
using Shape = std::variant<SphereShape, BoxShape, TubeShape, KnifeShape, NeedleShape, VolumeShape>;

enum class LatticeKind { fcc, voxel };

struct FixedBox { Vec3 min = Vec3::Zero(), max = Vec3::Zero(); };  // world [m]

/// A part of a body that is of another material, or empty: where the tissue rests, or how bright its image is.
struct BoxRegion { Vec3 min = Vec3::Zero(), max = Vec3::Zero(); };     // world [m]
struct BallRegion { Vec3 center = Vec3::Zero(); double radius = 0; };  // world [m]
struct IntensityRegion { double lo = 0, hi = 0; };                     // inclusive; of a volume only
struct RegionSpec {
  std::string material;
  std::variant<BoxRegion, BallRegion, IntensityRegion> where;
  Place place;
};

/// Material that is taken away from a shape.
struct CavitySpec {
  std::variant<BoxRegion, BallRegion> where;
  Place place;
};

struct BodySpec {
  std::string name;
  LatticeKind lattice = LatticeKind::fcc;
  std::optional<double> spacing;       // [m]; absent only for a volume of voxels, which brings its own
  std::string material;
  std::vector<RegionSpec> regions;     // of other materials; later ones win
  std::vector<CavitySpec> cavities;
  Vec3 at = Vec3::Zero();              // centre of the shape, or tip of a knife or needle [m]
  Eigen::Matrix3d orientation = Eigen::Matrix3d::Identity();  // R_WB about `at`, from theta_deg; fcc only
  Vec3 velocity = Vec3::Zero();        // [m/s]
  std::array<bool, 6> fixed_faces{};   // -x +x -y +y -z +z in its own frame: masses on that face are held
  std::vector<FixedBox> fixed_boxes;   // masses inside are held
  std::array<bool, 6> handle_faces{};  // of a tool, in its own frame: masses on that face move with the hand
  Shape shape = BoxShape{};
  Place place;
};

struct FloorSpec { double height = 0; };
/// A fixed plane; tissue stays on the side that the normal points to.
struct WallSpec {
  Vec3 point = Vec3::Zero();     // world [m]
  Vec3 normal = Vec3::UnitZ();   // of length 1
};

/// How bodies, and the fragments of bodies, touch each other.
///   paper  mass against mass at L / sqrt(3), whatever the stretch                              P0
///   swept  mass against facet, at a distance that follows the stretch, along the whole step
enum class ContactDistance { paper, swept };
struct ContactSpec {
  bool enabled = true;
  ContactDistance distance = ContactDistance::swept;
  double restitution = 1;        // relative speed after over before, [0, 1]
  bool count_passages = false;   // count masses that pass through facets
};

/// A point touches tissue by the plane under it; a body is one of the scene's, driven by masses that the hand holds.
enum class ToolShape { point, stick, body };
// norton: planes at zero force. tangent: wrench and its 6 x 6 stiffness. raw_planes, direct: as the papers have it
enum class ForceModel { norton, tangent, raw_planes, direct };

struct ToolSpec {
  std::string name;
  ToolShape shape = ToolShape::point;
  std::string body;               // name of the body that it is; only ToolShape::body
  std::string device;             // name of a [device.NAME]
  Vec3 set_point = Vec3::Zero();  // moments are about this point [m]
  double low_pass_Hz = 20;        // of the force and moment that a body reports
  double radius = 0.003;          // of the tip: its force fades out over twice that [m]
  double stiffness = 400;         // of the contact spring between hand and proxy [N/m]
  double damping = 1.0;           // [N s/m]
  double friction = 0;            // Coulomb's coefficient between tip and surface
  double torque_limit = 0.1;      // [N m]
  std::optional<ForceModel> force_model;  // of the hand between two answers of physics; absent: force_model_of()
  double length = 0.1;            // from tip to end [m]; only ToolShape::stick
  Eigen::Matrix3d attitude = Eigen::Matrix3d::Identity();  // where the handle is not turned; only ToolShape::stick
  Place place;
};
/// A point feels planes, all others a wrench.
inline ForceModel force_model_of(const ToolSpec& tool) {
  return tool.force_model.value_or(tool.shape == ToolShape::point ? ForceModel::norton : ForceModel::tangent);
}

struct Waypoint { double t = 0; Vec3 p = Vec3::Zero(); };  // [s], world [m]
enum class HandModel { rigid, arm, pinch, firm };

struct DeviceSpec {
  std::string name;
  std::string driver;
  double rate_Hz = 1000;
  double force_limit = 3.0;                               // [N]
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity(); // R_WD, det +1
  double scale = 1.0;                                     // world metres per device metre
  double force_scale = 1.0;                               // device newtons per world newton
  Vec3 offset = Vec3::Zero();                             // [m]
  std::vector<Waypoint> waypoints;                        // "simulated": in the world frame
  HandModel hand = HandModel::arm;                        // "simulated"
  std::vector<std::pair<std::string, std::string>> options;  // other keys, passed to the driver as text; "simulated": model
  Place place;
};

struct CameraSpec {
  double yaw = 0.6, pitch = 0.25;      // [rad] about the world z axis, above the horizon
  std::optional<double> distance;      // [m]; absent: all bodies fit
  std::optional<Vec3> target;          // [m]; absent: middle of all bodies
  double field_of_view = 0.6;          // [rad], vertical
};
struct RenderSpec {
  std::array<int, 2> size_px{1280, 720};
  CameraSpec camera;
  std::optional<double> threshold;     // intensity shown from; absent: each volume's keep_min
  bool show_tool = true, show_force = true, show_panels = true, show_wire = false;
  bool show_fragments = false;         // every fragment but the largest in a colour of its own
  double rate_Hz = 10;                 // frames per simulated second when headless
  // What the frames of one run may take on the disk. Where that is reached, every second one goes and half as many come.
  int most_frames = 400;
  double most_frame_bytes = 200e6;
};

struct RecordSpec {
  bool positions = false;              // positions of all masses
  bool forces = true;
  bool energy = true;                  // where the energy is, over time
  double rate_Hz = 50;
};

struct Scene {
  std::string title;
  std::string path;                    // of the scene file, as given
  std::uint64_t checksum = 0;          // of its text and the settings on the command line
  std::uint64_t seed = 1;
  std::optional<double> seconds;       // that a run lasts where nobody says otherwise [s]; absent: natural_seconds()
  Vec3 gravity{0, 0, -9.81};           // [m/s^2]
  PhysicsSpec physics;
  std::vector<BodySpec> bodies;
  std::vector<MaterialSpec> materials;
  std::optional<FloorSpec> floor;
  std::vector<WallSpec> walls;
  ContactSpec contact;
  std::vector<ToolSpec> tools;
  std::vector<DeviceSpec> devices;
  RenderSpec render;
  RecordSpec record;

  const MaterialSpec& material(const std::string& name) const;  // must exist
  const DeviceSpec& device(const std::string& name) const;      // must exist
  /// How long a run lasts where nobody says otherwise: as the scene has it, else to the end of the longest device path
  /// plus one second, five seconds where there is none [s].
  double natural_seconds() const;
};

}  // namespace palpate
