#pragma once
// The eye's end of the wire: takes everything that can be seen, tells how it fares, and passes the hand's wishes on.

#include <memory>
#include <optional>

#include "common/message/messages.h"
#include "common/process/node_main.h"
#include "common/wire/participant.h"
#include "common/wire/reader.h"
#include "common/wire/writer.h"
#include "render_node/model/view_model.h"

namespace palpate::render {

class Wire {
 public:
  explicit Wire(const Membership& membership);

  struct News {
    bool anything = false;
    bool stop = false;                // somebody commanded stop
    bool paused = false;              // commanded last
    std::optional<double> threshold;  // commanded by somebody
  };
  /// Takes all that has come into the model.
  News take_into(ViewModel& model);

  void command(CommandKind kind, double value = 0);
  void point(const Pointer& pointer) { pointer_.write(pointer); }
  /// Fills in what the readers counted, and sends.
  void tell(NodeStatus status);
  /// The session here is of another scene or version: the log says which. Looked at by tell().
  bool unwelcome() const noexcept { return unwelcome_; }

 private:
  template <class M>
  bool drain(Reader<M>& reader, M& buffer, ViewModel& model);
  bool drain_surfaces(ViewModel& model);
  template <class M>
  void count(Reader<M>& reader, NodeStatus& status);

  Participant participant_;
  Newcomer newcomer_{participant_};
  Reader<BodySurface> surfaces_{participant_};
  Reader<VertexBlock> blocks_{participant_};
  Reader<ToolWrench> wrenches_{participant_};
  Reader<HapticTrace> traces_{participant_};
  Reader<NodeStatus> statuses_{participant_};
  Reader<Command> commands_{participant_};
  Writer<NodeStatus> status_{participant_};
  Writer<Command> command_{participant_};
  Writer<Pointer> pointer_{participant_};
  std::uint64_t physics_ = 0;  // who sent the last surface
  std::uint64_t last_command_ = 0;
  bool paused_ = false;
  bool unwelcome_ = false;

  struct Buffers {
    BodySurface surface;
    VertexBlock block;
    ToolWrench wrench;
    HapticTrace trace;
    NodeStatus status;
  };
  std::unique_ptr<Buffers> buffers_ = std::make_unique<Buffers>();  // too large for a stack
};

}  // namespace palpate::render
