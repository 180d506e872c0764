#pragma once
// What the eye is told during a session, kept: to be drawn again and again.

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "common/message/messages.h"
#include "common/scene/scene.h"
#include "deploy/palpate/eye_messages.h"
#include "deploy/palpate/onlooker.h"
#include "render_node/picture.h"

namespace palpate::bench {

using EyeMessage = std::variant<BodySurface, SurfaceChange, VertexBlock, ToolWrench, HapticTrace>;

class MessageTape final : public deploy::Onlooker {
 public:
  /// @param most  pictures that are kept; rate and threshold are those of the scene
  MessageTape(const Scene& scene, int most) : scene_(scene), most_(most) {}

  void take(std::uint32_t tool, const TraceSample& sample) override;
  void frame(physics::World& world, std::int64_t now_ns) override;

  int pictures() const { return static_cast<int>(parts_.size()); }
  /// What came since the picture before; with the first all that was there.
  void play(int picture, render::Picture& eye) const;
  double t(int picture) const { return parts_[static_cast<std::size_t>(picture)].t; }

 private:
  struct Part {
    double t = 0;
    std::vector<EyeMessage> messages;
  };
  /// Takes messages as a picture does.
  struct Writer {
    std::vector<EyeMessage>& messages;
    template <class M>
    void take(const M& message) {
      messages.emplace_back(message);
    }
  };

  const Scene& scene_;
  int most_;
  std::unique_ptr<deploy::EyeMessages> source_;  // from the first frame on
  std::vector<EyeMessage> pending_;
  std::vector<Part> parts_;
  std::int64_t frames_ = 0;
};

}  // namespace palpate::bench
