#pragma once
// What went wrong while a scene ran, in words. One row of the table in run_warnings.cpp is one kind of trouble: the condition costs
// little to ask, the text is made once it holds.

#include <bitset>
#include <string>
#include <vector>

#include "physics_node/world.h"

namespace palpate::physics {

inline constexpr std::size_t most_warning_kinds = 32;
using WarningKinds = std::bitset<most_warning_kinds>;  // bit n: row n of the table

/// Which kinds of trouble the world is in or was in. Contract: allocates and throws nothing; a sum over rows and a few comparisons.
WarningKinds raised_warnings(const World& world) noexcept;

/// One line for each of these kinds, as things are now.
std::vector<std::string> warning_texts(const World& world, WarningKinds which);

/// The line about bodies that went into each other: who, how far, what would help.
std::string inside_text(const World& world, const InsideOthers& inside);

/// What a summary says: the remarks about the scene, then the lines of all kinds that hold.
std::vector<std::string> all_warnings(const World& world);

}  // namespace palpate::physics
