#pragma once
// Newton's method for a body of hexahedra: where it is after a step, or where it rests.

#include "physics_node/step/multigrid/conjugate_gradients.h"

namespace palpate::physics {

/// What is to be solved, besides what Newton's vectors hold.
struct NewtonTask {
  double dt = 0;    // 0: statics, without inertia [s]
  double beta = 0;  // of dampers: see Lagging; not for statics [s]
  double held = 0;  // elastic energy at D = 0, for a step [J]
  /// Of the residual, relative to the larger of the forces from outside and of the first residual; no finer than D has digits.
  double tolerance = 1e-3;
  int most_iterations = 12;
  int most_cycles = 80;  // V-cycles, in all
  std::span<const Plane> planes = {};
};

struct NewtonReport {
  int iterations = 0;
  int cycles = 0;                  // V-cycles
  int halvings = 0;                // of Newton steps
  double residual = 0, scale = 0;  // [N]
  double energy = 0;               // elastic, at the end [J]
  bool converged = false;
};

/// Finds the D for which
///
///   g(D) = M (D - coast) / dt^2 - f(u + D) - push = 0
///
/// the slope of  Phi = M |D - coast|^2 / (2 dt^2) + W(u + D) - push . D,  f and W with the dampers over the step.  Each system is solved by conjugate gradients to a tenth
/// of its residual, with the positive tangent on all levels of the hierarchy, so that every step leads downhill; a step is halved
/// until Phi falls (Armijo) or, where planes hold the same nodes as before, the residual does or half of its part along the step is gone
/// (Matthies & Strang 1979).
/// No node passes a plane: D is projected out of them, and what lies on a plane and is pressed into it is solved for in the other
/// directions only, while the plane takes the part of -g that presses (Bertsekas 1982: projected Newton). Where even a small step would
/// press a face into a plane that the whole body falls onto, it ends where the first node meets the plane. The planes that hold a node
/// are found anew in every iteration, from the sign of what they would take; what begins within a thousandth of a cell counts as lying there.
/// A step that ends with a larger Phi than it has at D = 0 is sought once more from there, from where Phi can only fall: no step leaves
/// more energy than there was.
/// Cost: bench/fem. Contract: allocates and throws nothing after construction; the same bits on any number of threads.
template <class Real>
class Newton {
 public:
  explicit Newton(const Body& body);

  /// By node of the fine level. D is where the search begins, and its answer.
  Three<Real> u, coast, push, D;
  Three<Real> force;     // of the elements, where they were asked last [N]
  Three<Real> reaction;  // of planes, where solve() ended; 0 without planes [N]

  NewtonReport solve(const Crew& crew, const NewtonTask& task) noexcept;
  /// Energy at u + D of the elements and, with a lag beta / dt, of their dampers [J]; `force` there.
  double evaluate(const Crew& crew, double lag) noexcept;
  /// Adds up of(node) over all nodes; by plane, and planes in order.
  template <class Of>
  double sum(const Crew& crew, const Of& of) noexcept {
    fine().each_plane(crew, [&](Index p) {
      const GridPlane& plane = fine().planes()[static_cast<std::size_t>(p)];
      double total = 0;
      for (Index i = plane.first; i < plane.last; ++i) total += of(static_cast<std::size_t>(i));
      by_plane_[static_cast<std::size_t>(p)] = total;
    });
    double total = 0;
    for (const double one : by_plane_) total += one;
    return total;
  }
  template <class Do>
  void each_node(const Crew& crew, const Do& work) noexcept {
    fine().each_plane(crew, [&](Index p) {
      const GridPlane& plane = fine().planes()[static_cast<std::size_t>(p)];
      for (Index i = plane.first; i < plane.last; ++i) work(static_cast<std::size_t>(i));
    });
  }
  /// Planes that hold a node, where solve() ended.
  PlaneSet held_by(std::size_t node) noexcept { return hierarchy_.supports().of(node); }
  double edge() const noexcept { return edge_; }  // of a cell, the shortest [m]
  /// Where it rests [m].
  Vec3 rest(std::size_t node) const noexcept { return vector_of(rest_, static_cast<Index>(node)); }
  const std::vector<Index>& storage() const noexcept { return hierarchy_.storage(); }
  const Level<Real>& fine() const noexcept { return hierarchy_.fine(); }

 private:
  /// Phi at D; minus g into the right side of the system, its norm into residual.
  double look(const Crew& crew, const NewtonTask& task, NewtonReport& report) noexcept;
  /// What the last digit of D is as a force, with the tangent taken last [N].
  double rounding(const Crew& crew) noexcept;
  /// Moves D out of the planes. @return how far at most [m]
  double keep_out_of(const Crew& crew, std::span<const Plane> planes) noexcept;
  /// Sets on the planes what hovers over them and is driven into them. Why: unheld it would be solved for as if it were to fall, and the
  /// line search, which soon meets the plane, gives up. @return whether any did
  bool land(const Crew& crew, std::span<const Plane> planes) noexcept;
  /// The share of the step x at which the first node that is not on a plane yet meets one; more than 1: none does.
  double first_touch(const Crew& crew, std::span<const Plane> planes) noexcept;
  /// Of what lies on planes: holds also what they let go and the step x presses into them all the same, as the rest of the body takes it
  /// along. @return whether there is any
  bool hold_what_is_driven_in(const Crew& crew, std::span<const Plane> planes) noexcept;
  /// As where the search began?
  bool holds_as_before(const Crew& crew, std::span<const Plane> planes) noexcept;
  /// x of gradients_, for the right side and the supports of now.
  void find_step(const Crew& crew, const NewtonTask& task, NewtonReport& report) noexcept;
  /// Takes from the right side of a node what planes hold, and notes it.
  void find_reaction(std::size_t node, std::span<const Plane> planes) noexcept;
  void begin(const Crew& crew, const NewtonTask& task) noexcept;
  bool search(const Crew& crew, const NewtonTask& task, double& phi, NewtonReport& report) noexcept;

  Hierarchy<Real> hierarchy_;
  ConjugateGradients<Real> gradients_;
  Three<Real> from_;
  Three<double> rest_;                // places at rest
  std::vector<PlaneSet> at_;          // planes on which a node lies; none without planes
  std::vector<PlaneSet> held_from_;   // which of them hold it where a search begins
  std::vector<std::uint8_t> beyond_;  // the body's shape: no plane meets it
  double edge_ = 0;                   // of a cell, the shortest [m]
  std::vector<double> by_plane_;
  double dt_ = 0;  // that the levels are set to
};

}  // namespace palpate::physics
