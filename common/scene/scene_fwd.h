#pragma once
// Names of a scene and its tables, for headers that only pass them on.

namespace palpate {

struct Scene;
struct BodySpec;
struct ConnectionSpec;
struct ContactSpec;
struct DeviceSpec;
struct MaterialSpec;
struct PhysicsSpec;
struct RecordSpec;
struct RenderSpec;
struct ToolSpec;
struct WallSpec;

}  // namespace palpate
