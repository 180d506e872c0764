#pragma once
// Everything the eye knows, fed by messages alone. No graphics here: gl/ draws it, ui/ writes its numbers.

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/math/vec3.h"
#include "common/message/messages.h"
#include "common/scene/scene_fwd.h"
#include "render_node/model/body_picture.h"
#include "render_node/model/hand_clock.h"
#include "render_node/model/history.h"

namespace palpate::render {

/// One tool, as far as messages have told.
struct ToolView {
  std::string name;                                              // as in the scene
  std::optional<Vec3> tip;                                       // of the newest trace sample [m]
  Vec3 proxy = Vec3::Zero();                                     // [m]; meaningless without tip
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();  // of the handle
  bool answered = false;                                         // physics has said what follows
  Vec3 force = Vec3::Zero();                                     // of the tissue on the tool [N]
  Vec3 moment = Vec3::Zero();                                    // about the set point [N m]
  Vec3 set_point = Vec3::Zero();                                 // [m]
  Vec3 tip_in_tissue = Vec3::Zero();                             // of the tool, where physics has it [m]
  double stretch = 0;                                            // as in ToolWrench [m]
  std::uint32_t n_contacts = 0;
  double energy = 0;  // given to the hand so far [J]
  double path_s = 0;  // of a simulated hand, from when its forces are on to the end; 0: there is none [s]
  std::optional<double> path_began;  // when forces were first on, by the hand's clock [s]
  // All against the time of the hand (hand_clock.h).
  HandClock clock{1000};
  History on_tool;                        // magnitude of the tissue's force [N]
  History on_hand;                        // magnitude of the device's force [N]
  std::array<History, 3> moment_history;  // about x, y, z through the set point [N m]
};

class ViewModel {
 public:
  explicit ViewModel(const Scene& scene);

  void take(const BodySurface& chunk);
  void take(const SurfaceChange& page);
  void take(const VertexBlock& block);
  void take(const ToolWrench& wrench);
  void take(const HapticTrace& trace);
  void take(const NodeStatus& status);

  /// Another physics sends from now on: its surfaces and blocks are numbered anew.
  void begin_anew() noexcept;

  /// Brings normals up to date with the positions; call before drawing.
  void refresh();

  std::span<BodyPicture> bodies() noexcept { return bodies_; }
  std::span<const BodyPicture> bodies() const noexcept { return bodies_; }
  /// Of bodies, in the order of bodies_with_section(); empty where none has come.
  std::span<const BodyPicture> sections() const noexcept {
    return std::span(bodies_).subspan(first_section_, first_inside_ - first_section_);
  }
  std::span<const ToolView> tools() const noexcept { return tools_; }
  const std::optional<NodeStatus>& node(NodeKind kind) const noexcept {
    return nodes_[static_cast<std::size_t>(kind)];
  }

  /// Every tool's hand is simulated and has come to the end of its path.
  bool path_is_over() const noexcept;

  double t() const noexcept { return t_; }  // newest simulated time heard of [s]
  bool anything_to_see() const noexcept;    // at least one body is whole
  Eigen::AlignedBox3d box() const;          // round the first revision of all bodies [m]
  std::size_t facets_visible() const noexcept;
  std::size_t facets_total() const noexcept;
  std::uint64_t samples_ignored() const noexcept {
    return ignored_;
  }  // stale, malformed, too large or about nothing known
  std::size_t memory_used() const noexcept { return budget_->used; }
  /// How often something was not kept because it would have been too much (memory_budget.h).
  std::uint64_t memory_refused() const noexcept { return budget_->refused; }

 private:
  template <class M>
  void take_part(const M& part);

  std::shared_ptr<MemoryBudget> budget_ = std::make_shared<MemoryBudget>();
  std::vector<BodyPicture>
      bodies_;  // as in the scene, its connections behind, then sections, then what lies inside
  std::size_t first_section_ = 0, first_inside_ = 0;
  std::vector<ToolView> tools_;  // as in the scene
  std::array<std::optional<NodeStatus>, n_node_kinds> nodes_;
  double t_ = 0;
  std::uint64_t ignored_ = 0;
};

}  // namespace palpate::render
