#pragma once
// A scene that uses most keys, and what the tests of the reader do with it. scene_tables.h has every key.

#include <string>
#include <vector>

#include "common/scene/scene_fwd.h"

namespace palpate::test {

/// Most keys of a scene file once. The volume it names lies in scene_folder().
extern const char* const full_scene;

/// The shortest scene that is right.
extern const char* const least_scene;

/// A folder of this test's own, with an empty scan.h5 in it; removed at the end of the process.
const std::string& scene_folder();

/// The complaints about a scene at scene_folder()/s.toml, with the folder cut off: "s.toml:3:1: ...".
/// Empty if the scene is right.
std::vector<std::string> complaints_about(const std::string& text,
                                          const std::vector<std::string>& settings = {});

/// The scene, which is to be right.
Scene parsed(const std::string& text, const std::vector<std::string>& settings = {});

}  // namespace palpate::test
