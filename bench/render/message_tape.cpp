#include "bench/render/message_tape.h"

namespace palpate::bench {

void MessageTape::take(std::uint32_t tool, const TraceSample& sample) {
  if (!source_ || pictures() >= most_) return;
  Writer writer{pending_};
  source_->take(tool, sample, writer);
}

void MessageTape::frame(physics::World& world, std::int64_t now_ns) {
  if (!source_) source_ = std::make_unique<deploy::EyeMessages>(scene_, world);
  if (frames_++ % deploy::frames_a_picture(scene_, world) != 0 || pictures() >= most_) return;
  Writer writer{pending_};
  source_->write(world, now_ns, writer);
  parts_.push_back({world.t(), std::move(pending_)});
  pending_.clear();
}

void MessageTape::play(int picture, render::Picture& eye) const {
  for (const EyeMessage& message : parts_[static_cast<std::size_t>(picture)].messages)
    std::visit([&eye](const auto& one) { eye.take(one); }, message);
}

}  // namespace palpate::bench
