// What a break sends of a surface: to the eye as it is drawn, whatever the order in which it arrives and whoever comes late, and in
// bytes on the wire.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "common/scene/device_spec.h"
#include "common/scene/load_scene.h"
#include "common/scene/scene.h"
#include "common/scene/shape_spec.h"
#include "common/wire/convert.h"
#include "deploy/import/brain_phantom.h"
#include "physics_node/appearance/appearance.h"
#include "physics_node/boundary/loose_parts.h"
#include "render_node/model/body_picture.h"
#include "tests/support/image/scratch_folder.h"
#include "tests/support/physics/made_volume.h"
#include "tests/support/physics/small_worlds.h"

namespace palpate::physics {
namespace {

using namespace test;
using render::BodyPicture;

/// As it leaves the process and comes into another one.
template <class Wire, class M>
M over_the_wire(const M& message) {
  const auto wire = std::make_unique<Wire>();
  to_wire(message, *wire);
  M got;
  const Verdict verdict = from_wire(*wire, got);
  EXPECT_FALSE(verdict) << verdict->field;
  return got;
}

/// All that was written in one go.
struct Post {
  std::vector<std::unique_ptr<BodySurface>> chunks;
  std::vector<SurfaceChange> pages;
  std::vector<std::unique_ptr<VertexBlock>> blocks;

  explicit Post(Appearance& appearance) {
    appearance.poll();
    appearance.write_surfaces(
        {[this](const BodySurface& chunk) {
           chunks.push_back(std::make_unique<BodySurface>(over_the_wire<palpate_wire_BodySurface>(chunk)));
         },
         [this](const SurfaceChange& page) {
           pages.push_back(over_the_wire<palpate_wire_SurfaceChange>(page));
         }});
    appearance.write_blocks([this](const VertexBlock& block) {
      blocks.push_back(std::make_unique<VertexBlock>(over_the_wire<palpate_wire_VertexBlock>(block)));
    });
  }
  std::size_t bytes() const {
    return chunks.size() * sizeof(palpate_wire_BodySurface) +
           pages.size() * sizeof(palpate_wire_SurfaceChange);
  }
  std::size_t bytes_if_whole(const BodyPicture& shown) const {
    if (bytes() == 0) return 0;
    const auto chunks_for = [](std::size_t n, std::size_t per) { return (n + per - 1) / per; };
    return sizeof(palpate_wire_BodySurface) *
           std::max(chunks_for(shown.surface().position.size(), max_surface_vertices),
                    chunks_for(shown.surface().corners.size(), max_surface_facets));
  }
  using Handing = std::function<void(BodyPicture&)>;
  std::vector<Handing> in_order() const {
    std::vector<Handing> all;
    for (const auto& chunk : chunks) all.push_back([&](BodyPicture& to) { to.take(*chunk); });
    for (const auto& page : pages) all.push_back([&](BodyPicture& to) { to.take(page); });
    for (const auto& block : blocks) all.push_back([&](BodyPicture& to) { to.take(*block); });
    return all;
  }
};

/// What DDS keeps for those who come late: the last of each chunk and of each page.
class Kept {
 public:
  void take(const Post& post) {
    for (const auto& chunk : post.chunks) chunks_[chunk->chunk] = *chunk;
    for (const auto& page : post.pages) pages_[page.page] = page;
  }
  /// In some order, and then where everything is now.
  std::unique_ptr<BodyPicture> late_reader(const Post& now, std::mt19937& engine) const {
    auto reader = std::make_unique<BodyPicture>();
    std::vector<Post::Handing> all;
    for (const auto& [n, chunk] : chunks_) all.push_back([&](BodyPicture& to) { to.take(chunk); });
    for (const auto& [n, page] : pages_) all.push_back([&](BodyPicture& to) { to.take(page); });
    for (const auto& block : now.blocks) all.push_back([&](BodyPicture& to) { to.take(*block); });
    std::shuffle(all.begin(), all.end(), engine);
    for (const auto& hand : all) hand(*reader);
    return reader;
  }

 private:
  std::map<std::uint32_t, BodySurface> chunks_;
  std::map<std::uint32_t, SurfaceChange> pages_;
};

using Facets = std::multiset<std::array<std::uint32_t, 5>>;  // corners from the first one on, and colour

/// The surface made anew, and where its vertices are now.
class Truth {
 public:
  Truth(const World& world, std::optional<double> threshold) {
    const BodyModel& moving = world.body(0);
    const LiveElements live(moving);
    const std::uint32_t rgba = body_colour(world.scene(), 0);
    surface_ = make_surface(moving.body(), live, threshold, rgba);
    add_loose_parts(moving.body(), live, threshold, rgba, surface_);
    for (std::uint32_t v = 0; v < surface_.n_vertices(); ++v) {
      place_.push_back(surface_.position(v, moving));
      by_x_.emplace(place_.back().x(), v);
    }
  }
  Facets facets() const {
    Facets all;
    for (std::size_t f = 0; f < surface_.facets.size(); ++f) {
      const auto& c = surface_.facets[f];
      all.insert({c[0], c[1], c[2], c[3], surface_.rgba[f]});
    }
    return all;
  }
  /// Of a reader: its vertices by the nodes that they lie at; one that lies at none is none of them.
  Facets facets_of(const BodyPicture& reader) const {
    const auto& shown = reader.surface();
    std::vector<std::uint32_t> node;
    for (const Array3f& p : shown.position) node.push_back(node_at({p[0], p[1], p[2]}));
    Facets all;
    for (std::size_t f = 0; f < shown.corners.size(); ++f) {
      const auto& c = shown.corners[f];
      all.insert({node[c[0]], node[c[1]], node[c[2]], node[c[3]], shown.rgba[f]});
    }
    return all;
  }
  std::uint64_t hidden() const { return surface_.hidden; }

 private:
  std::uint32_t node_at(const Vec3& p) const {
    constexpr double near = 3e-5;  // [m]; a vertex that moves by less than 1e-5 along each axis is not told
    for (auto at = by_x_.lower_bound(p.x() - near); at != by_x_.end() && at->first < p.x() + near; ++at)
      if ((place_[at->second] - p).norm() < near) return at->second;
    return 0xffffffffU;
  }
  Surface surface_;
  std::vector<Vec3> place_;
  std::multimap<double, std::uint32_t> by_x_;
};

/// A body whose left half is 100 and whose right half is 300, with rigid scenery round what can be torn.
Scene image_scene(const std::string& file) {
  write_volume(made_volume({14, 12, 10}, [](int i, int, int) { return i < 7 ? 100.F : 300.F; }), file);
  Recipe recipe = fragile("voxel", Recipe::box(40, 40, 40));
  Scene scene = scene_of(recipe);
  BodySpec body = volume_body(file, 50, 400);
  body.material = scene.bodies[0].material;
  std::get<VolumeShape>(body.shape).deformable = {
      .all = false, .center_voxel = {7, 6, 8}, .radius_voxels = 4};
  scene.bodies = {body};
  return scene;
}

/// Fcc, voxels, and voxels of an image in their scenery.
class SurfaceChanges : public testing::TestWithParam<std::string> {
 protected:
  SurfaceChanges()
      : world_(GetParam() == "image" ? image_scene(folder_ / "made.h5")
                                     : scene_of(fragile(GetParam(), Recipe::box(120, 120, 100)))),
        appearance_(world_, std::nullopt) {}

  /// Breaks all elements of some masses, and puts every mass where no other round has it.
  void tear(int n_masses, int round) {
    BodyModel& body = world_.body(0);
    const auto& masses = body.body().lattice.masses;
    std::vector<Index> torn;
    for (int n = 0; n < n_masses; ++n)
      torn.push_back(
          masses[static_cast<std::size_t>(dice_.between(0, 0.999999) * static_cast<double>(masses.size()))]);
    double far = 1;
    for (const Index mass : masses) body.place(mass, Vec3::Zero(), Vec3::Zero());
    for (const Index mass : torn) body.place(mass, Vec3(0, 0, far++), Vec3::Zero());
    body.advance({.dt = 1e-9, .watch = true}, {});
    for (const Index mass : masses)
      body.place(mass, Vec3(round % 4, round % 3, mass % 5) * 3e-4, Vec3::Zero());
  }

  /// Everybody is told, and must then know how it is.
  void tell_and_compare(const std::string& what) {
    if (round_++ % 2 == 1) appearance_.resend();
    const Post post(appearance_);
    kept_.take(post);
    auto shuffled = post.in_order();
    for (const auto& hand : shuffled) hand(steady_);
    std::shuffle(shuffled.begin(), shuffled.end(), engine_);
    for (const auto& hand : shuffled) hand(shuffled_);
    n_whole_ += post.chunks.empty() ? 0 : 1;
    n_changes_ += post.pages.empty() ? 0 : 1;
    const Truth truth(world_, threshold_);
    const Facets expected = truth.facets();
    ASSERT_EQ(truth.facets_of(steady_), expected) << what;
    ASSERT_EQ(truth.facets_of(shuffled_), expected) << what << ", in any order";
    EXPECT_EQ(steady_.surface().facets_hidden, truth.hidden()) << what;
    if (round_ % 2 == 1) return;  // only now everything is where it is
    const auto late = kept_.late_reader(post, engine_);
    ASSERT_EQ(truth.facets_of(*late), expected) << what << ", of a late reader";
    EXPECT_EQ(late->surface().facets_hidden, truth.hidden());
  }

  palpate::test::ScratchFolder folder_;
  World world_;
  Appearance appearance_;
  std::optional<double> threshold_;
  Dice dice_{8};
  std::mt19937 engine_{9};
  BodyPicture steady_, shuffled_;
  Kept kept_;
  int round_ = 0, n_whole_ = 0, n_changes_ = 0;
};
INSTANTIATE_TEST_SUITE_P(Bodies, SurfaceChanges, testing::Values("fcc", "voxel", "image"));

TEST_P(SurfaceChanges, GiveEveryReaderTheSurfaceAsItIsMadeAnew) {
  tell_and_compare("at the start");
  for (int run = 0; run < 3; ++run) {
    for (int n = 0; n < 16; ++n) {
      tear(1 + n % 4 * 2, n);
      tell_and_compare(fmt::format("run {}, break {}", run, n));
      if (HasFatalFailure()) return;
    }
    if (GetParam() == "image") {
      for (const double threshold : {200.0, 350.0, 60.0}) {
        threshold_ = threshold;
        appearance_.set_threshold(threshold);
        tear(1, 1);
        tell_and_compare(fmt::format("run {}, threshold {}", run, threshold));
        if (HasFatalFailure()) return;
      }
    }
    if (run == 1) appearance_.publish_anew(0);
    world_.reset();
    tell_and_compare("after a reset");
    if (HasFatalFailure()) return;
  }
  EXPECT_GE(n_whole_, 3) << "at the start, on request, and where more has changed than there is";
  EXPECT_GT(n_changes_, 40);
}

/// The brain of scenes/, until its knife has cut 500 elements, looked at as the eye does.
TEST(SurfaceOfABrain, CostsATwentiethOfWholeSurfacesWhenItIsCut) {
  const palpate::test::ScratchFolder folder;
  write_brain_phantom(folder / "brain");
  World world(load_scene(std::string(SCENES) + "/brain_cut_slow.toml",
                         {"body.brain.files=" + (folder / "brain/slice_*.png")}));
  Appearance appearance(world, std::nullopt);
  BodyPicture reader;
  const Post first(appearance);
  for (const auto& one : first.in_order()) one(reader);
  const auto& path = world.scene().device("hand").waypoints;
  const double speed = (path.back().p - path.front().p).z() / (path.back().t - path.front().t);
  std::optional<ToolState> hand = ToolState();
  hand->engaged = 1;
  const auto brain_only = [](Post& post) {
    std::erase_if(post.chunks, [](const auto& chunk) { return chunk->body != 0; });
    std::erase_if(post.pages, [](const auto& page) { return page.body != 0; });
    std::erase_if(post.blocks, [](const auto& block) { return block->body != 0; });
  };
  std::size_t sent = 0, whole = 0;
  int looks = 0;
  for (int frame = 1; world.body(0).breaks() < 500; ++frame) {
    ASSERT_LT(frame, 1000) << "the knife cuts nothing";
    const Vec3 p = path.front().p + Vec3(0, 0, speed * world.t());
    hand->tick = static_cast<std::uint64_t>(frame);
    hand->p_WT = hand->proxy = {p.x(), p.y(), p.z()};
    hand->v_WT = {0, 0, speed};
    world.frame(std::span(&hand, 1));
    if (frame % 33 != 0) continue;
    Post post(appearance);
    brain_only(post);
    for (const auto& one : post.in_order()) one(reader);
    sent += post.bytes();
    whole += post.bytes_if_whole(reader);
    looks += post.bytes() > 0 ? 1 : 0;
  }
  const Truth truth(world, std::nullopt);
  fmt::print("{} breaks, seen in {} looks: {} of {} bytes, {:.2f} %\n", world.body(0).breaks(), looks, sent,
             whole, 100.0 * static_cast<double>(sent) / static_cast<double>(whole));
  EXPECT_GE(looks, 10) << "the cut is seen as it goes";
  EXPECT_LE(static_cast<double>(sent), 0.05 * static_cast<double>(whole));
  EXPECT_EQ(appearance.surface_bytes().sent, sent) << "the knife does not break";
  EXPECT_EQ(appearance.surface_bytes().whole, whole);
}

}  // namespace
}  // namespace palpate::physics
