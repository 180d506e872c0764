#pragma once
// The physics side of a trial by the real thing: a slab of tissue in a World, pressed by a point or by a stick. Nothing is
// stood in for but the network and the hand.

#include <memory>
#include <optional>
#include <vector>

#include "bench/haptic/models.h"
#include "common/scene/kinds.h"
#include "common/scene/scene_fwd.h"
#include "physics_node/world.h"

namespace palpate::bench {

/// What the slab is made of, and what it is pressed with. `about` is how stiff it feels, for the hand to aim.
struct SlabModel {
  const char* name;
  const char* material;  // keys of a [material]
  bool stick;
  double about;           // [N/m]
  bool held = false;      // every mass of it: a wall
  const char* body = "";  // further keys of its [[body]]
};
inline constexpr std::array<SlabModel, 3> slab_models{
    {{"slab 30 kPa", "modulus_kPa = 30\nviscosity_Pa_s = 10", false, 270},
     {"slab 100 kPa", "modulus_kPa = 100\nviscosity_Pa_s = 20", false, 900},
     {"yielding slab", "modulus_kPa = 60\nviscosity_Pa_s = 10\nyield_ratio = 1.03\nbreak_ratio = 3", false,
      400}}};
inline constexpr std::array<SlabModel, 2> solid_slabs{
    {{"slab 30 kPa, elements", "modulus_kPa = 30\npoisson_ratio = 0.45\nviscosity_Pa_s = 10", false, 400,
      false, "model = \"fem\""},
     {"slab 100 kPa, elements", "modulus_kPa = 100\npoisson_ratio = 0.45\nviscosity_Pa_s = 20", false, 1300,
      false, "model = \"fem\""}}};
inline constexpr SlabModel held_slab{"held slab", "modulus_kPa = 100", false, rigid_stiffness, true};
inline constexpr SlabModel stick_slab{"slab 100 kPa, stick", "modulus_kPa = 100\nviscosity_Pa_s = 20", true,
                                      1500};

/// The slab's scene, with the force model as one may name it; a point, or a stick that lies on it, touches at z = 0.
Scene slab_scene(const SlabModel& slab, std::optional<ForceModel> model, double rate_Hz,
                 double hand_stiffness, double hand_damping, double friction = 0);

class WorldObject {
 public:
  explicit WorldObject(const Scene& scene) : world_(scene) {}
  /// One frame. The whole world stands on a table, which may be moved slowly: hand and answers are seen from beside it.
  /// @param hand   newest known; null: nothing fresh
  /// @param table  its height [m]
  void frame(const ToolState* hand, double table, std::int64_t now_ns, ContactPatch& patch,
             ToolWrench& wrench);
  const physics::World& world() const { return world_; }

 private:
  physics::World world_;
};

}  // namespace palpate::bench
