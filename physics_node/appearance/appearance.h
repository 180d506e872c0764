#pragma once
// What physics sends to the eye: the visible surface of every body and the strands between them, then only what
// changes in it and the blocks of vertices that moved. Free of DDS: the messages go to whoever asks.

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "common/message/messages.h"
#include "physics_node/appearance/change_pages.h"
#include "physics_node/appearance/colours.h"
#include "physics_node/appearance/moved_blocks.h"
#include "physics_node/appearance/numbered_surface.h"
#include "physics_node/appearance/strand_picture.h"
#include "physics_node/appearance/surface_bytes_report.h"
#include "physics_node/boundary/section_surface.h"
#include "physics_node/boundary/surface.h"
#include "physics_node/world.h"

namespace palpate::physics {

/// Who makes a surface anew: poll() itself, so that pictures are the same each time, or a thread of its own meanwhile, so
/// that frames go on.
enum class Remake { at_once, beside };

/// Who takes what there is to tell of surfaces.
struct SurfaceSinks {
  std::function<void(const BodySurface&)> whole;
  std::function<void(const SurfaceChange&)> change;
};

class Appearance {
 public:
  /// @param threshold  intensity from which tissue is shown; absent: all tissue
  Appearance(const World& world, std::optional<double> threshold, Remake how = Remake::at_once);

  /// Shows tissue from another intensity on; poll() takes the new surfaces.
  void set_threshold(double threshold);

  /// Shows another section of bodies of cells, or none; poll() takes it. It begins with the scene's.
  void set_section(const std::optional<SectionSpec>& section);

  /// Shows what lies inside of images from another intensity on, or not; poll() takes it. It begins with the scene's.
  void set_inside(const std::optional<double>& from);

  /// What colours are to say: blocks then hold the field, of bodies that have it. It begins with the scene's.
  void set_colour(ColourKind kind);

  /// Takes finished surfaces, and follows elements that broke or came back: of each body that has such, a copy of its live
  /// elements goes into a new surface. Costs next to nothing where none has. Allocates: not for inside a frame.
  /// @return true if write_surfaces has something new
  bool poll();

  /// Polls until surfaces are those of the state of now, or for so long. @return true: they are
  bool settle(std::chrono::milliseconds at_most);

  /// What is new since the last call: of each body all chunks of its surface, or pages of what changed in it. It is sent whole the
  /// first time, and when the pages since it was last would weigh more than that. Cost: of what is written, not of what exists.
  /// @return chunks and pages
  int write_surfaces(const SurfaceSinks& sinks);

  /// The surface with this number is written whole next time: a part of it has been lost.
  void publish_anew(std::size_t number);

  /// Blocks in which a vertex moved by more than a hundredth of a millimetre, or changed its flags, since they were
  /// last written. @return blocks
  int write_blocks(const std::function<void(const VertexBlock&)>& sink);

  /// Writes every block again next time: somebody new is looking.
  void resend();

  std::size_t facets_visible() const;  // loose elements and masses are not facets
  std::size_t facets_total() const;
  const SurfaceBytes& surface_bytes() const { return bytes_; }

 private:
  enum class Due { nothing, change, whole };
  struct Listed {
    std::size_t vertices = 0, facets = 0;
  };
  struct View {
    std::size_t body = 0;
    std::uint32_t number = 0;       // to the eye
    std::optional<GreyScale> grey;  // of a section
    bool inside = false;            // of what lies inside
    NumberedSurface shown;
    std::unique_ptr<LiveElements> live;        // what it was, or is being, made from; else that of its body
    std::unique_ptr<FragmentColours> colours;  // the same; null where fragments have none
    std::int64_t breaks = 0;                   // of the body then
    std::uint32_t revision = 0;
    Due due = Due::nothing;
    ChangePages pages;  // of this revision
    Listed listed;      // in them, or due
    std::vector<FacetChange> due_facets;
    std::size_t n_told = 0;  // vertices
    MovedBlocks blocks;
    std::unique_ptr<TissueField> field;  // that colours show; null: none
  };
  /// A new surface of a body: its changes, or where those weigh too much the whole.
  struct Made {
    std::size_t view = 0;
    std::optional<NumberedSurface> whole;
    SurfaceDelta delta;
  };
  struct Job {
    std::size_t view = 0;
    Listed listed;
  };
  Surface surface_of(std::size_t view) const;
  /// A section, or what lies inside, that is not to be shown.
  bool is_out(const View& view) const { return (view.grey && !section_) || (view.inside && !inside_); }
  Made make(const Job& job) const;
  std::vector<Job> outdated();
  void copy(std::size_t body);
  void show(Made made);
  void begin_whole(View& view);
  int write_whole(View& view, const std::function<void(const BodySurface&)>& sink);
  int write_change(View& view, const std::function<void(const SurfaceChange&)>& sink);

  const World& world_;
  std::vector<View> views_;  // of bodies, then of sections, then of what lies inside
  std::vector<StrandPicture> strands_;
  std::optional<double> threshold_;     // of the surfaces shown or being made
  std::optional<double> wanted_;        // threshold asked for since
  std::optional<SectionSpec> section_;  // likewise, of those shown or being made
  std::optional<std::optional<SectionSpec>> wanted_section_;
  std::optional<double> inside_;  // likewise
  std::optional<std::optional<double>> wanted_inside_;
  Remake how_;
  std::int64_t restored_ = 0;  // how often the guard had gone back when surfaces were last looked at
  std::unique_ptr<BodySurface> chunk_ = std::make_unique<BodySurface>();
  std::unique_ptr<VertexBlock> block_ = std::make_unique<VertexBlock>();
  std::vector<Array3f> new_vertices_;  // that are being written
  SurfaceBytes bytes_;
  std::future<std::vector<Made>> pending_;  // the last member: it is waited for before what it reads goes
};

}  // namespace palpate::physics
