#pragma once
// The eye's end of the wire: takes everything that can be seen, tells how it fares, and passes the hand's wishes on.

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/message/messages.h"
#include "common/process/node_main.h"
#include "common/scene/colour_kind.h"
#include "common/scene/inside_spec.h"
#include "common/scene/section_spec.h"
#include "common/wire/participant.h"
#include "common/wire/reader.h"
#include "common/wire/refusals.h"
#include "common/wire/speaker.h"
#include "common/wire/writer.h"
#include "render_node/model/view_model.h"

namespace palpate::render {

class Wire {
 public:
  explicit Wire(const Membership& membership);

  struct News {
    bool anything = false;
    bool stop = false;                                  // somebody commanded stop
    bool paused = false;                                // commanded last
    std::optional<double> threshold;                    // commanded by somebody
    std::optional<std::optional<SectionSpec>> section;  // likewise
    std::optional<std::optional<double>> inside;        // likewise: intensity from which it is shown
    std::optional<ColourKind> colour;                   // likewise
  };
  /// Takes all that has come into the model.
  News take_into(ViewModel& model);

  /// @param name  of what it is about, of less than 64 characters; see Command
  void command(CommandKind kind, double value = 0, const std::string& name = {});
  void point(const Pointer& pointer) { pointer_.write(pointer); }
  /// Fills in what the readers counted, and sends; says who is not heard.
  void tell(NodeStatus status);
  /// What has come so far, by topic.
  std::vector<Heard> heard();
  /// The session here is of another scene or version: the log says which. Looked at by tell().
  bool unwelcome() const noexcept { return unwelcome_; }

 private:
  template <class M>
  bool drain(Reader<M>& reader, M& buffer, ViewModel& model);
  void follow_physics(ViewModel& model);
  bool drain_statuses(ViewModel& model);

  // Physics at rest says little more than its status, five times a second.
  static constexpr std::chrono::seconds silence{1};
  static constexpr int most_commands = 64;  // a picture; what is more waits

  Participant participant_;
  Newcomer newcomer_{participant_};
  Speaker physics_{participant_, "physics", silence};
  Speaker hand_{participant_, "haptic", silence};
  Speaker people_{participant_, {"render", "supervisor"}};
  // All three anew when another physics speaks: it then sends all that it has told so far.
  std::unique_ptr<Reader<BodySurface>> surfaces_ =
      std::make_unique<Reader<BodySurface>>(participant_, &physics_);
  std::unique_ptr<Reader<SurfaceChange>> changes_ =
      std::make_unique<Reader<SurfaceChange>>(participant_, &physics_);
  std::unique_ptr<Reader<VertexBlock>> blocks_ =
      std::make_unique<Reader<VertexBlock>>(participant_, &physics_);
  Reader<ToolWrench> wrenches_{participant_, &physics_};
  Reader<HapticTrace> traces_{participant_, &hand_};
  Reader<NodeStatus> statuses_{participant_};
  Reader<Command> commands_{participant_, &people_};
  Writer<NodeStatus> status_{participant_};
  Writer<Command> command_{participant_};
  Writer<Pointer> pointer_{participant_};
  std::uint64_t physics_changes_ = 0;  // how often another physics had taken over, at the last look
  ReaderCounts surfaces_before_, changes_before_, blocks_before_;  // of the readers before those
  std::uint64_t last_command_ = 0;
  bool memory_told_ = false;
  bool paused_ = false;
  bool unwelcome_ = false;

  struct Buffers {
    BodySurface surface;
    SurfaceChange change;
    VertexBlock block;
    ToolWrench wrench;
    HapticTrace trace;
    NodeStatus status;
  };
  std::unique_ptr<Buffers> buffers_ = std::make_unique<Buffers>();  // too large for a stack
};

}  // namespace palpate::render
