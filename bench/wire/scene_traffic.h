#pragma once
// What the nodes say in a session of a scene, as they counted it themselves.

#include <map>
#include <optional>
#include <string>

namespace palpate::bench {

struct Traffic {
  double wall_s = 0;
  bool shared = false;  // through shared memory
  struct Topic {
    double samples = 0, bytes = 0;
  };
  std::map<std::string, Topic> topics;  // of all nodes that count
  double publish_share = 0;             // of physics' wall time that telling the eye took
};

/// Runs the scene live with pictures to files. @return nothing if the session failed; why it did stands on stderr
std::optional<Traffic> measure_scene_traffic(const std::string& scene, const std::string& nodes,
                                             double seconds);

}  // namespace palpate::bench
