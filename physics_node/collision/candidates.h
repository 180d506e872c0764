#pragma once
// The masses of a body that may touch something: those with fewer live elements than deep inside the lattice.
// Elements that break add to them, so the new surfaces of a crack are there at once. (EQUATIONS C-12)

#include <cstdint>
#include <span>
#include <vector>

#include "physics_node/boundary/exposed_nodes.h"
#include "physics_node/step/body_model.h"

namespace palpate::physics {

class Candidates {
 public:
  /// @param with_front  also nodes that lie open (boundary/exposed_nodes.h), and the neighbours of those that lost elements, which a
  ///   blade inside a cut meets next.
  Candidates(const BodyModel& moving, bool with_front);

  /// Finds them anew: after a reset, or when elements came back.
  void restart() noexcept;
  /// Takes the ends of elements that broke.
  void follow(const TopologyEvents& events) noexcept;

  /// Reads where they were when the step of dt just integrated began, and how fast; with dt = 0 where they are now.
  /// @param which  of them; the others stay as they were last read
  /// @param shift  by which all have moved together since then; moved() tells how far they went from there [m]
  /// @return false: some number is not finite
  bool refresh(double dt, std::span<const std::uint32_t> which, const Vec3& shift) noexcept;
  std::span<const std::uint32_t> all() const { return {all_.data(), cell_.size()}; }
  /// How far one of them moved at most between the last two readings [m].
  double moved() const { return moved_; }

  std::size_t size() const { return cell_.size(); }
  const std::vector<Index>& cell() const { return cell_; }
  const std::vector<Vec3>& rest() const { return rest_; }      // position at rest [m]
  const std::vector<Vec3>& x() const { return x_; }            // position [m]
  const std::vector<Vec3>& v() const { return v_; }            // velocity [m/s]
  const std::vector<Vec3>& v_move() const { return v_move_; }  // that moves it in the step [m/s]
  double inverse_mass(std::size_t n) const {
    return inverse_mass_[n];
  }  // 0: held, or driven by a hand [1/kg]
  /// Number of the candidate in a storage cell, -1: it is none.
  std::int32_t at_cell(Index cell) const { return number_[static_cast<std::size_t>(cell)]; }
  /// Does a live element join these two?
  bool are_joined(std::size_t a, std::size_t b) const noexcept;

  const BodyModel& moving() const { return *moving_; }
  double length() const { return length_; }  // L, by which contact distances go [m]
  std::size_t most() const { return most_; }

 private:
  void add(Index cell) noexcept;
  void add_front(Index cell) noexcept;
  void add_sides(Index node) noexcept;

  const BodyModel* moving_;
  double length_ = 0;
  double longest_element_ = 0;  // at rest [m]
  std::size_t most_ = 0;
  ExposedNodes exposed_;
  bool with_front_ = false;
  std::vector<Index> cell_;
  std::vector<Vec3> rest_, x_, v_, v_move_;
  std::vector<Vec3> last_x_;
  std::vector<std::uint32_t> all_;  // 0, 1, 2 ...
  double moved_ = 0;
  std::vector<double> inverse_mass_;
  std::vector<std::int32_t> number_;  // by storage cell
};

}  // namespace palpate::physics
