#pragma once
// Names of a scene and its tables, for headers that only pass them on.

namespace palpate {

struct Scene;
struct BodySpec;
struct DeviceSpec;
struct MaterialSpec;
struct RenderSpec;
struct ToolSpec;
struct WallSpec;

}  // namespace palpate
