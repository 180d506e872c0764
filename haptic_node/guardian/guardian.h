#pragma once
// The node's side of palpate-guardian: a small process of its own that outlives the node, and switches off what the node has
// left on. It hears a byte for each tool whose motors are off for good; the end of the pipe is the end of the node, whatever
// has ended it. It is started only for drivers that can do something from outside (hdev_api.rescue).

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

#include "haptic_node/device/device.h"

namespace palpate::haptic {

class Guardian {
 public:
  /// Before any motors are on. A guardian that does not start is one line in the log.
  /// @param tools  by tool; null: nothing to rescue
  explicit Guardian(std::vector<const RescueWords*> tools);
  /// All motors are off by now.
  ~Guardian();
  Guardian(const Guardian&) = delete;
  Guardian& operator=(const Guardian&) = delete;

  /// The motors of this tool are off, and stay so. From signal handlers, too.
  void off(std::size_t tool) noexcept;

  /// Now and then, from a slow thread: starts another one if it has died.
  void look_after();

 private:
  void start();
  void end() noexcept;

  std::vector<std::vector<std::string>> words_;  // of each tool, as the command line has them
  int pipe_ = -1;
  pid_t pid_ = -1;
  int starts_ = 0;
};

}  // namespace palpate::haptic
