#pragma once
// A scene as plain data, in SI. One file serves all three nodes; each uses its part.
// Read by load_scene.h. What is absent in the file is absent here (std::optional) or has the default in its
// header: body_spec.h, tool_spec.h and so on, one for each table.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/math/vec3.h"
#include "common/scene/floor_spec.h"
#include "common/scene/indirect.h"
#include "common/scene/scene_fwd.h"

namespace palpate {

/// The tables are incomplete types here: a file that reads one includes its header, and a new key compiles only those
/// files again. The special members are therefore defined in scene.cpp.
struct Scene {
  Scene();
  Scene(const Scene&);
  Scene(Scene&&) noexcept;
  Scene& operator=(const Scene&);
  Scene& operator=(Scene&&) noexcept;
  ~Scene();

  std::string title;
  std::string path;            // of the scene file, as given
  std::uint64_t checksum = 0;  // of its text and the settings on the command line
  std::uint64_t seed = 1;
  /// That a run lasts where nobody says otherwise [s]; absent: natural_seconds().
  std::optional<double> seconds;
  Vec3 gravity{0, 0, -9.81};  // [m/s^2]
  Indirect<PhysicsSpec> physics;
  std::vector<BodySpec> bodies;
  std::vector<ConnectionSpec> connections;
  std::vector<MaterialSpec> materials;
  std::optional<FloorSpec> floor;
  std::vector<WallSpec> walls;
  Indirect<ContactSpec> contact;
  std::vector<ToolSpec> tools;
  std::vector<DeviceSpec> devices;
  Indirect<RenderSpec> render;
  Indirect<RecordSpec> record;

  const MaterialSpec& material(const std::string& name) const;  // must exist
  const DeviceSpec& device(const std::string& name) const;      // must exist
  /// How long a run lasts where nobody says otherwise: as the scene has it, else to the end of the longest
  /// device path plus one second, five seconds where there is none [s].
  double natural_seconds() const;
};

}  // namespace palpate
