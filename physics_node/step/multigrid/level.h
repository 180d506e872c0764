#pragma once
// One level at work: its numbers, and sweeps over them by one thread or a team.

#include "physics_node/step/lattice/state.h"
#include "physics_node/step/multigrid/level_kernel.h"
#include "physics_node/step/team.h"

namespace palpate::physics {

/// Who sweeps.
struct Crew {
  Team* team = nullptr;  // null: no team
  int threads = 1;

  /// work(n) for n in [0, count), in any order.
  template <class Work>
  void each(std::size_t count, const Work& work) const noexcept {
    if (team != nullptr && threads > 1 && count > 1)
      team->each(count, threads, work);
    else
      for (std::size_t n = 0; n < count; ++n) work(n);
  }
};

template <class Real>
NodeVector<Real> pointers(Three<Real>& three) {
  return {three[0].data(), three[1].data(), three[2].data()};
}

/// Sums have an order that depends on the level alone. Contract: allocates and throws nothing after construction.
template <class Real>
class Level {
 public:
  /// @param mass  of each node [kg]; of held ones it does not count
  Level(const GridLevel& grid, const std::vector<DenseCell>& dense, const std::vector<double>& mass,
        const HexMaterial& material);

  Index n_nodes() const noexcept { return n_nodes_; }
  const std::vector<GridPlane>& planes() const noexcept { return planes_; }
  const std::vector<DenseCell>& dense() const noexcept { return dense_cells_; }
  const CellBatches& cells() const noexcept { return cells_; }
  /// Points to what this owns; other members may be made to point elsewhere.
  LevelContext<Real> context() noexcept;

  /// Mass over dt^2; 0 without dt: statics.
  void set_step(double dt) noexcept;
  /// Takes the tangent at u, and scales it.
  void linearise(const Crew& crew, double scale) noexcept;
  /// A sweep over layers and then over each plane that is complete: layer(l), plane(l).
  template <class LayerWork, class PlaneWork>
  void sweep(const Crew& crew, const LayerWork& layer, const PlaneWork& plane) const noexcept {
    const std::size_t n_slabs = cells_.slabs.size() - 1;
    const auto slab = [&](std::size_t s) {
      for (std::size_t l = cells_.slabs[s]; l < cells_.slabs[s + 1]; ++l) {
        layer(static_cast<Index>(l));
        if (l > cells_.slabs[s] || n_slabs == 1) plane(static_cast<Index>(l));
      }
    };
    crew.each(n_slabs, slab);
    if (n_slabs > 1)  // the lowest waits for the slab below
      crew.each(n_slabs, [&](std::size_t s) { plane(static_cast<Index>(cells_.slabs[s])); });
  }
  /// Work on planes alone.
  template <class PlaneWork>
  void each_plane(const Crew& crew, const PlaneWork& plane) const noexcept {
    crew.each(cells_.slabs.size() - 1, [&](std::size_t s) {
      for (std::size_t l = cells_.slabs[s]; l < cells_.slabs[s + 1]; ++l) plane(static_cast<Index>(l));
    });
  }
  const LevelKernel<Real>& kernel() const noexcept { return kernel_; }

  Three<Real> u, x, r, d;

 private:
  Index n_nodes_;
  std::vector<GridPlane> planes_;
  CellBatches cells_;
  std::vector<DenseCell> dense_cells_;
  std::vector<Index> dense_corners_;
  ZeroedArray<Real> tangent_, dense_, mass_kg_, mass_, free_;
  Three<Real> low_, high_;
  std::array<ZeroedArray<Real>, 6> inverse_, block_high_;
  HexConstants<Real> k_;
  LevelKernel<Real> kernel_;
  double scale_ = 1;
};

}  // namespace palpate::physics
