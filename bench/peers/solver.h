#pragma once
// One way of stepping the drop: palpate or a peer, with a scheme, a precision and a number of threads.

#include <memory>
#include <string>
#include <vector>

#include "bench/peers/drop.h"

namespace palpate::bench {

/// What a run is asked for.
struct Task {
  const Drop* drop = nullptr;
  int frames = 0;           // of 1 ms
  int steps_per_frame = 1;  // equal steps
  bool positions = true;    // false: only the time is wanted

  int steps() const { return frames * steps_per_frame; }
  double dt() const { return frame_seconds / steps_per_frame; }
};

struct Run {
  bool sound = false;              // stable and finite
  std::vector<Vec3> displacement;  // at the end [m]                     (n_masses)
  double cpu_s = 0;                // of all threads, stepping only: no loading, no writing
  double wall_s = 0;
};

/// Explicit schemes of the same order on the same springs give the same trajectory but for rounding.
enum class Scheme { symplectic_euler, leapfrog };

struct Method {
  std::string peer;       // "palpate", "LAMMPS", ...
  std::string name;       // of scheme or variant
  std::string precision;  // "single" | "double"
  int threads = 1;        // or ranks
  Scheme scheme = Scheme::leapfrog;
  double expected_ns = 10;      // of a mass and step, roughly: how long a measurement is made
  std::vector<int> drop_steps;  // steps per frame to try on the drop; empty: the drop is not run
  int largest_body = 1 << 30;   // masses

  std::string label() const;
};

class Solver {
 public:
  virtual ~Solver() = default;
  virtual const Method& method() const = 0;
  virtual Run run(const Task& task) = 0;
};

/// A peer: how it is named, what it solves, and its solvers, none where it is not installed.
struct Peer {
  std::string name;
  std::string version;    // empty where not found
  std::string package;    // of Debian
  std::string not_equal;  // what is not equal work, one sentence
  std::vector<std::unique_ptr<Solver>> solvers;
};

/// palpate in double precision on one thread.
std::unique_ptr<Solver> palpate_reference(Scheme scheme);

Peer palpate_peer();
Peer lammps_peer();
Peer bullet_peer();
Peer mujoco_peer();

}  // namespace palpate::bench
