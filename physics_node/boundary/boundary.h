#pragma once
// What tools can touch of a body: its facets as it was loaded and, of a body that breaks, those that have opened since. A facet
// that has lost what it bounded is gone.
//
// A facet belongs to one site (site_facets.h). Where elements break, the sites near them are looked at again, at most
// most_sites_a_frame in a frame; what is left waits for the next one. Cost: what breaks, not what exists.

#include <array>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "physics_node/boundary/live_skin.h"
#include "physics_node/boundary/site_facets.h"
#include "physics_node/boundary/surface.h"
#include "physics_node/step/body_model.h"

namespace palpate::physics {

/// The whole tissue surface of a body with what is needed to find facets near a point. Scenery is found through a
/// grid of buckets; moving facets are looked through one by one, and the caller keeps what it found for a while.
class Boundary {
 public:
  /// @param follows  facets open and go where elements break; only of a body that yields, else it costs nothing
  Boundary(const BodyModel& moving, double bucket_size, bool follows = false);

  /// As loaded.
  const Surface& surface() const { return surface_; }
  double bucket_size() const { return bucket_size_; }

  /// After each step: what broke in it. Allocates nothing.
  void follow() noexcept;
  /// Once a frame, before tools look: opens facets and takes others away. Allocates nothing.
  void update() noexcept;
  /// Another number whenever some facet has opened or gone; those of before may then stand for others.
  std::uint64_t revision() const noexcept { return revision_; }
  /// May a facet have opened or gone near `p` since `revision`? Near: a mass that lost an element lies within `radius` now, or it is
  /// no longer known which did.
  bool changed_near(const Vec3& p, double radius, std::uint64_t revision,
                    const NodeMotion& moving) const noexcept;
  /// Open facets now, and how many in all there was no room for.
  std::size_t n_open() const noexcept { return n_open_; }
  std::uint64_t left_out() const noexcept { return left_out_; }

  /// Appends the facets whose centroid lies within `radius` of `p` now, but for lips of cuts that lie on each other: to a tool tissue is
  /// there as whole as before. Allocates only while `out` grows.
  void facets_near(const Vec3& p, double radius, const NodeMotion& moving,
                   std::vector<std::uint32_t>& out) const;
  /// No more than so many numbers are ever appended at once.
  std::size_t most_facets() const noexcept { return surface_.facets.size() + open_.size(); }

  // Of one facet. Its corners 2 and 3 are one where it is a triangle.
  bool exists(std::uint32_t facet) const noexcept;
  bool is_triangle(std::uint32_t facet) const noexcept;
  /// Facets that meet in a corner have the same number of it; below the capacity of the body it is that of the mass
  /// that it is.
  std::int64_t corner(std::uint32_t facet, std::size_t corner) const noexcept;
  /// Who carries a corner; nobody: rigid scenery.
  Bearers bearers(std::uint32_t facet, std::size_t corner) const noexcept;
  /// The mass whose corner it is, -1: rigid scenery. A smooth skin has others carry it, too.
  Index mass(std::uint32_t facet, std::size_t corner) const noexcept;
  bool has_mass(std::uint32_t facet) const noexcept;  // at a corner; else it is scenery
  Vec3 position(std::uint32_t facet, std::size_t corner, const NodeMotion& moving) const noexcept;
  Vec3 rest(std::uint32_t facet, std::size_t corner) const noexcept;  // without any load [m]
  Vec3 centroid(std::uint32_t facet, const NodeMotion& moving) const noexcept;
  Vec3 rest_area(std::uint32_t facet) const noexcept;  // of the body without any load, as below [m^2]
  /// Where the facet lay when the body was loaded, sagged where that starts balanced: there it comes back to when nothing
  /// presses. Of a facet that opened since, at rest.
  Vec3 settled_centroid(std::uint32_t facet) const noexcept;
  Vec3 settled_area(std::uint32_t facet) const noexcept;
  /// The centroid and, half the cross product of the diagonals, the normal times the area [m^2].
  struct CentroidAndArea {
    Vec3 centroid, area;
  };
  CentroidAndArea centroid_and_area(std::uint32_t facet, const NodeMotion& moving) const noexcept;

  /// Why: a bound for frames in which hundreds of elements break. Measured on bodies torn all over (one core, gcc 12 -O2): 0.2 us a
  /// site of fcc, 1.4 us of voxels, so 0.8 and 6 ms at the most.
  static constexpr std::size_t most_sites_a_frame = 4096;

 private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  struct OpenFacet {
    SiteFacets::Corners masses{};
    SiteFacets::Corners across{-1, -1, -1, -1};  // of a lip of a cut: of the other lip
    std::uint32_t next = none;                   // of the same site, or free
    bool open = false;
  };

  std::size_t bucket_of(const Vec3& p) const;
  void prepare_to_follow();
  /// The vertex as loaded at a corner; none: a mass that had none.
  std::optional<std::uint32_t> vertex(std::uint32_t facet, std::size_t corner) const noexcept;
  const Bearers* carried(std::uint32_t vertex) const noexcept;
  /// The corner of a lip that it is; else null.
  const LiveSkin::Lip* lip(std::uint32_t facet, std::size_t corner) const noexcept {
    return skin_ && !is_loaded(facet) ? skin_->lip(open_at(facet).masses[corner]) : nullptr;
  }
  Vec3 displacement(std::uint32_t vertex, const NodeMotion& moving) const noexcept;  // of one that moves
  Vec3 place(std::uint32_t vertex, const NodeMotion& moving) const noexcept;
  Vec3 now(Index mass, const NodeMotion& moving) const noexcept;
  /// Is it a lip of a cut, on which the other one lies? Nothing comes between them.
  bool is_shut(std::uint32_t facet, const NodeMotion& moving) const noexcept;
  Vec3 nearly_centroid(std::uint32_t facet, const NodeMotion& moving) const noexcept;
  Vec3 settled(std::uint32_t facet, std::size_t corner) const noexcept;
  bool is_loaded(std::uint32_t facet) const noexcept { return facet < surface_.facets.size(); }
  const OpenFacet& open_at(std::uint32_t facet) const noexcept {
    return open_[facet - surface_.facets.size()];
  }
  void mark(Index mass) noexcept;
  void restart() noexcept;
  bool is_facet(std::uint32_t facet, const SiteFacets::Corners& masses) const noexcept;
  /// @param first, last  facets as loaded
  bool is_as_loaded(std::size_t first, std::size_t last,
                    std::span<const SiteFacets::Corners> now) const noexcept;
  void close_all(std::uint32_t site) noexcept;
  void open(std::uint32_t site, const SiteFacets::Corners& masses) noexcept;
  void renew(std::uint32_t site) noexcept;

  const BodyModel& body_;
  Surface surface_;
  std::vector<Vec3> sag_;  // of moving vertices when the body was loaded; EMPTY: none (n_moving)
  double bucket_size_;
  Vec3 low_ = Vec3::Zero();
  Vec3i n_buckets_ = Vec3i::Ones();
  std::vector<std::uint32_t>
      moving_facets_;  // may be anywhere: of a body awake in parts none, all are near to where they rest
  std::vector<std::uint32_t> bucket_start_;  // facets of bucket b: bucket_facets_[start[b] .. start[b + 1])
  std::vector<std::uint32_t> bucket_facets_;

  std::unique_ptr<LiveSkin> skin_;     // of one that is smooth and follows breaks; else null
  std::unique_ptr<SiteFacets> sites_;  // null: follows no breaks
  std::vector<std::uint8_t> gone_;     // of each facet as loaded; EMPTY without sites_
  std::vector<std::uint32_t> first_;   // open facet of each site
  std::vector<std::uint8_t> waits_;    // of each site: it is in queue_
  std::vector<std::uint32_t> queue_;   // a ring of sites to be looked at again  (n_sites)
  std::size_t queue_begin_ = 0, n_queued_ = 0;
  std::vector<OpenFacet> open_;  // n_used_ of them have been in use
  std::size_t n_used_ = 0, n_open_ = 0;
  std::uint32_t free_ = none;
  struct Change {
    Index mass = 0;
    std::uint64_t revision = 0;  // with which its facets are new
  };
  std::array<Change, 64> changes_{};  // the last ones, a ring
  std::uint64_t n_changes_ = 0;
  std::uint64_t changed_all_ = 0;  // the last revision in which anything may have changed
  std::uint64_t revision_ = 0;
  std::uint64_t left_out_ = 0;
};

}  // namespace palpate::physics
