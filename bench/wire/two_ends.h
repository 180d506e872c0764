#pragma once
// Two processes at the two ends of a wire. The benchmark itself never joins a domain: what iceoryx and DDS keep for a
// process would be inherited by the next.

#include <functional>
#include <vector>

#include "common/wire/participant.h"

namespace palpate::bench {

/// How the ends talk.
enum class Path { udp, memory };

inline constexpr int bench_domain = 98;
/// Of that domain, through shared memory unless the environment refuses it.
Membership bench_membership();

/// Runs both ends, each in a process of its own with `path` forced upon it, and gives what `first` answers. `second` is
/// killed if it has not ended ten seconds after `first`.
/// @return empty if an end failed
std::vector<double> run_ends(Path path, const std::function<std::vector<double>()>& first,
                             const std::function<void()>& second);

/// Processor time of this process until now [s].
double cpu_s();

}  // namespace palpate::bench
