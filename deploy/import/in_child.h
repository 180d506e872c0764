#pragma once
// Libraries that read other people's images crash on some damaged ones. In a child process that is one line more.

#include <functional>
#include <string>

namespace palpate {

/// Runs `work` in a child process and gives back its exit code. SIGINT and SIGTERM go on to the child.
/// @param waiting  called in the parent every `every_s` seconds while the child works, with the seconds since it began
/// @return -n if the child was ended by signal n
int run_in_child(
    const std::function<int()>& work, const std::function<void(int)>& waiting = [](int) {},
    unsigned every_s = 10);

}  // namespace palpate
