// How a body of tetrahedra takes the copies of nodes that a cut makes (mesh/simplex_net.h).
//
// A copy has the displacement and velocity of the node that it splits off from, and each of both the quarters of its
// own tetrahedra: mass, momentum and angular momentum stay as they are but for rounding, and so does the energy of
// what each tetrahedron holds by itself. With nodal pressure U = sum of lambda V_n j_n^2 / 2, j_n = sum of V_t (J_t -
// 1) / (4 V_n) over the tetrahedra at n: parted, sums of squares are no less than the square of the sum.

#include <algorithm>

#include "physics_node/material/lame.h"
#include "physics_node/step/fem/four_array.h"
#include "physics_node/step/fem/tetrahedra.h"

namespace palpate::physics {

/// J - 1.
template <class Real>
double Tetrahedra<Real>::volume_change(std::size_t tet) const noexcept {
  const auto& corners = model_.mesh.tets[tet];
  const auto slopes = slopes_of(model_.mesh, corners);
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  for (std::size_t k = 0; k < 3; ++k)
    F += (displacement(corners[k + 1]) - displacement(corners[0])) * slopes[k].transpose();
  return F.determinant() - 1;
}

/// Of what swelling holds at all that was one node when it was loaded [J].
/// @param after  by the corners of the net; else by those that are in use
template <class Real>
double Tetrahedra<Real>::swollen_energy(Index node, const TetNet& net, bool after) noexcept {
  swollen_.clear();
  net.each_around(node, [&](Index t, std::size_t corner) {
    const auto tet = static_cast<std::size_t>(t);
    const Index of = after ? net.corners(t)[corner] : model_.mesh.tets[tet][corner];
    const auto material = static_cast<std::size_t>(model_.mesh.region[tet]);
    auto at = std::ranges::find_if(swollen_,
                                   [&](const Swollen& s) { return s.node == of && s.material == material; });
    if (at == swollen_.end()) {
      if (swollen_.size() == swollen_.capacity()) return;
      swollen_.push_back({of, material, 0, 0});
      at = swollen_.end() - 1;
    }
    const double quarter = signed_volume(model_.mesh, model_.mesh.tets[tet]) / 4;
    at->volume += quarter;
    at->change += quarter * volume_change(tet);
  });
  double energy = 0;
  for (const Swollen& s : swollen_) {
    const TetMaterial& material = model_.materials[s.material];
    energy += 0.5 * lame_of(material.modulus, material.poisson_ratio).lambda * s.change * s.change / s.volume;
  }
  return energy;
}

template <class Real>
void Tetrahedra<Real>::write_corner(std::size_t lane, std::size_t corner) noexcept {
  batches_[lane / tet_lanes].corner[lane % tet_lanes][corner] =
      static_cast<std::uint16_t>(corner_step<Real> * layout_.corner[4 * lane + corner]);
}

template <class Real>
double Tetrahedra<Real>::mass(Index node, const TetNet& net) const noexcept {
  double sum = 0;
  net.each_corner(node, [&](Index t, std::size_t) {
    const auto tet = static_cast<std::size_t>(t);
    const TetMaterial& material = model_.materials[static_cast<std::size_t>(model_.mesh.region[tet])];
    sum += 0.25 * (material.density * signed_volume(model_.mesh, model_.mesh.tets[tet]));
  });
  return sum;
}

/// How fast a share swelled a step ago.
template <class Real>
Real Tetrahedra<Real>::rate_before(Index node, std::size_t material) const noexcept {
  const auto& nodes = layout_.node_of_share;
  const auto n_loaded = static_cast<std::ptrdiff_t>(loaded_->node_of_share.size());
  auto at = std::lower_bound(nodes.begin(), nodes.begin() + n_loaded, node);
  if (at == nodes.begin() + n_loaded || *at != node)
    at = std::find(nodes.begin() + n_loaded, nodes.end(), node);
  for (; at != nodes.end() && *at == node; ++at)
    if (const auto s = static_cast<std::size_t>(at - nodes.begin()); layout_.material_of_share[s] == material)
      return mean_rate_before_[s];
  return 0;
}

/// Mass, and volumes of its shares.
template <class Real>
void Tetrahedra<Real>::measure_again(Index node, const TetNet& net) noexcept {
  const auto n = static_cast<std::size_t>(node);
  if (inverse_mass_[n] > 0) inverse_mass_[n] = static_cast<Real>(1 / mass(node, net));
  if (kernel_.elastic.swell == nullptr) return;
  for (Index e = layout_.of_node.begin[n]; e < layout_.of_node.begin[n + 1]; ++e) {
    const auto share = static_cast<std::size_t>(
        layout_.share[static_cast<std::size_t>(layout_.of_node.part[static_cast<std::size_t>(e)])]);
    const std::size_t material = layout_.material_of_share[share];
    double volume = 0;
    net.each_corner(node, [&](Index t, std::size_t) {
      const auto tet = static_cast<std::size_t>(t);
      if (static_cast<std::size_t>(model_.mesh.region[tet]) == material)
        volume += signed_volume(model_.mesh, model_.mesh.tets[tet]) / 4;
    });
    const TetMaterial& of = model_.materials[material];
    share_volume_[share] = volume > 0 ? static_cast<Real>(1 / volume) : Real(0);
    share_energy_[share] = 0.5 * lame_of(of.modulus, of.poisson_ratio).lambda * volume;
  }
}

template <class Real>
double Tetrahedra<Real>::separate(std::span<const NodeSplit> splits, const TetNet& net) noexcept {
  if (splits.empty()) return 0;
  double grown = 0;
  const bool nodal = kernel_.elastic.swell != nullptr, damped = model_.beta > 0;
  for (auto split = splits.begin(); nodal && split != splits.end(); ++split) {
    const Index origin = net.origin(split->node);
    if (std::any_of(splits.begin(), split, [&](const NodeSplit& s) { return net.origin(s.node) == origin; }))
      continue;
    grown += swollen_energy(origin, net, true) - swollen_energy(origin, net, false);
  }
  for (const auto& [node, copy] : splits) {
    const auto from = static_cast<std::size_t>(node), to = static_cast<std::size_t>(copy);
    model_.mesh.nodes.push_back(model_.mesh.nodes[from]);
    if (!model_.held.empty()) model_.held.push_back(model_.held[from]);
    inverse_mass_[to] = inverse_mass_[from];
    set_vector(u_, to, displacement(node));
    set_vector(v_, to, velocity(node));
    if (damped) set_vector(began_, to, vector_at(began_, static_cast<std::size_t>(node)));
    if (damped) set_vector(seen_rate_, to, Vec3::Zero());  // its part is with the node, which is as fast
    const std::size_t first_new = layout_.node_of_share.size();
    give_copy(layout_, *lanes_, net, copy);
    for (std::size_t s = first_new; nodal && damped && s < layout_.node_of_share.size(); ++s)
      mean_rate_before_[s] = rate_before(node, layout_.material_of_share[s]);
    net.each_corner(copy, [&, copy = copy](Index tet, std::size_t corner) {
      model_.mesh.tets[static_cast<std::size_t>(tet)][corner] = copy;
      write_corner(lanes_->lane(tet), corner);
    });
  }
  list_anew(layout_, n_nodes());
  for (const auto& [node, copy] : splits) measure_again(node, net), measure_again(copy, net);
  return grown;
}

template <class Real>
void Tetrahedra<Real>::rejoin() noexcept {
  if (!loaded_) return;
  const std::size_t n = loaded_->of_node.begin.size() - 1;
  layout_ = *loaded_;
  model_.mesh.nodes.resize(n);
  if (!model_.held.empty()) model_.held.resize(n);
  for (const TetBlock& block : layout_.blocks)
    for (std::size_t lane = block.first_batch * tet_lanes;
         lane < (block.first_batch + block.n_batches) * tet_lanes; ++lane)
      for (std::size_t a = 0; a < 4; ++a) {
        write_corner(lane, a);
        if (layout_.tet[lane] >= 0)
          model_.mesh.tets[static_cast<std::size_t>(layout_.tet[lane])][a] =
              layout_.node[block.first_part + layout_.corner[4 * lane + a]];
      }
  const auto masses = masses_of(model_);
  for (std::size_t i = 0; i < n; ++i)
    if (inverse_mass_[i] > 0) inverse_mass_[i] = static_cast<Real>(1 / masses[i]);
  if (kernel_.elastic.swell != nullptr) find_share_volumes();
  rate_known_ = false;
}

#define PALPATE_SEPARATION_OF(Real)                                                               \
  template double Tetrahedra<Real>::separate(std::span<const NodeSplit>, const TetNet&) noexcept; \
  template void Tetrahedra<Real>::rejoin() noexcept;                                              \
  template double Tetrahedra<Real>::mass(Index, const TetNet&) const noexcept;

PALPATE_SEPARATION_OF(float)
PALPATE_SEPARATION_OF(double)
#undef PALPATE_SEPARATION_OF

}  // namespace palpate::physics
