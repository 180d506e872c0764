#pragma once
// Where a figure comes from. No figure of ours is worth more than its commit, compiler and machine.

#include <nlohmann/json.hpp>

namespace palpate::bench {

/// {commit, compiler, flags, cpu, cores, instruction_set, load, date}: one per file of results. `load` is the average of
/// running processes over the last minute, without which a time on a shared machine says little.
nlohmann::json machine();

}  // namespace palpate::bench
