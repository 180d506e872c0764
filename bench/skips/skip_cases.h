#pragma once
// What a scene may lack, each as two scenes that differ in that alone.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/message/messages.h"
#include "common/scene/scene.h"

namespace palpate::bench {

struct SkipCase {
  std::string skip;     // what is left out
  std::string without;  // the scene that needs it not, in words
  std::string with;     // the scene that does
  Scene lean, full;     // in that order
  int frames = 200;
  bool shaken = true;  // all masses move from the start
};

/// All cases. The volumes that two of them need are written to `folder`.
std::vector<SkipCase> skip_cases(const std::filesystem::path& folder);

}  // namespace palpate::bench
