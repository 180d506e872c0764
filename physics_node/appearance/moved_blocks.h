#pragma once
// Which vertices of one body have moved, or changed their state, since they were last sent.

#include <cmath>
#include <functional>
#include <vector>

#include "physics_node/appearance/numbered_surface.h"
#include "physics_node/appearance/tissue_field.h"
#include "physics_node/step/body_model.h"

namespace palpate::physics {

/// As the wire has positions.
inline Array3f float_of(const Vec3& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

/// By more than a hundredth of a millimetre; what has not been sent, which is not a number, has.
inline bool is_seen_to_move(const Array3f& sent, const Array3f& now) {
  constexpr float visible_motion = 1e-5F;  // [m]
  for (std::size_t a = 0; a < 3; ++a)
    if (!(std::abs(now[a] - sent[a]) <= visible_motion)) return true;
  return false;
}

class MovedBlocks {
 public:
  /// Of so many vertices, none of which has been sent.
  void begin(std::size_t n_vertices);
  /// The surface has new ones, of which its reader knows where they lie at rest.
  void grow(const NumberedSurface& surface);
  /// All blocks are written again next time.
  void resend();

  /// Gives the sink every block in which a vertex moved by more than a hundredth of a millimetre, changed its flags,
  /// or the field by a hundredth of the largest in the block.
  /// @param field  that colours show; null: none
  /// @param block  what does not depend on the block is filled in  @return blocks
  int write(const NumberedSurface& surface, const BodyModel& moving, const TissueField* field,
            VertexBlock& block, const std::function<void(const VertexBlock&)>& sink);

 private:
  void look_at(const NumberedSurface& surface, const BodyModel& moving, const TissueField* field,
               std::size_t first, std::size_t last);
  bool changed(const NumberedSurface& surface, const BodyModel& moving, std::size_t first,
               std::size_t last) const;

  std::vector<Array3f> sent_;             // positions as last written  (n_vertices)
  std::vector<std::uint8_t> sent_flags_;  // (n_vertices)
  std::vector<float> sent_field_;         // (n_vertices)
  std::vector<std::uint8_t>
      sent_at_rest_;  // of each block, 1: it was written since all of it rests, or needs not be
  // Of the block that is looked at.
  std::vector<Index> cells_;           // of its vertices that move
  std::vector<Condition> conditions_;  // of these
  std::vector<std::uint8_t> flags_;    // of its vertices
  std::vector<float> field_;           // likewise
  float field_most_ = 0;               // the largest of them
};

}  // namespace palpate::physics
