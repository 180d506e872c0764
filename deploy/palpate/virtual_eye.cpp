#include "deploy/palpate/virtual_eye.h"

#include "common/scene/render_spec.h"
#include "common/scene/scene.h"

namespace palpate::deploy {

VirtualEye::VirtualEye(const Scene& scene, const physics::World& world)
    : messages_(scene, world),
      picture_(scene),
      spec_(*scene.render),
      every_(frames_a_picture(scene, world)) {}

void VirtualEye::leave_in(const std::filesystem::path& out) { folder_.emplace(out, spec_); }

void VirtualEye::take(std::uint32_t tool, const TraceSample& sample) {
  messages_.take(tool, sample, picture_);
}

void VirtualEye::frame(physics::World& world, std::int64_t now_ns) {
  if (seen_++ % every_ == 0 && (!folder_ || folder_->wants_next())) draw(world, now_ns);
}

void VirtualEye::draw(physics::World& world, std::int64_t now_ns) {
  messages_.write(world, now_ns, picture_);
  picture_.draw(world.t());
  ++drawn_;
  if (folder_) folder_->keep(picture_.image());
}

nlohmann::json VirtualEye::summary(physics::World& world, double wall_s) {
  messages_.write(world, static_cast<std::int64_t>(1e9 * world.t()), picture_);
  nlohmann::json summary = {{"frames", drawn_},
                            {"fps", wall_s > 0 ? drawn_ / wall_s : 0.0},
                            {"facets_visible", picture_.facets_visible()},
                            {"facets_total", picture_.facets_total()}};
  if (!folder_) return summary;
  folder_->settle();
  summary["frames"] = folder_->kept();
  if (folder_->lost() > 0) summary["frames_lost"] = folder_->lost();
  if (folder_->every() > 1)
    summary.update({{"frames_left_out", folder_->left_out()}, {"frames_every", folder_->every()}});
  return summary;
}

}  // namespace palpate::deploy
