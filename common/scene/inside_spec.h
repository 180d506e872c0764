#pragma once
// What lies inside of an image: a second surface below its skin, of all that is at least so intense; bone in a head.
// Only what is seen: felt is the body.

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "common/scene/scene_fwd.h"

namespace palpate {

/// As a Command names it: "from"; "none" where it is not shown.
std::string_view inside_name(const std::optional<double>& from) noexcept;
/// What a Command says. Nothing: none, or another name.
std::optional<double> inside_of(std::string_view name, double intensity) noexcept;

/// The bodies of which it can be shown, those of cells of an image, in their order. To the eye each is one more body, behind
/// the sections. @return no more than there are numbers for
std::vector<std::size_t> bodies_with_inside(const Scene& scene);

}  // namespace palpate
