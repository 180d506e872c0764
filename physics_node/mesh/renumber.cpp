#include "physics_node/mesh/renumber.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>

namespace palpate::physics {
namespace {

constexpr int bits_an_axis = 21;

/// The low bits of `n`, two zeros between each and the next.
std::uint64_t spread(std::uint64_t n) noexcept {
  n = (n | n << 32) & 0x001f00000000ffffULL;
  n = (n | n << 16) & 0x001f0000ff0000ffULL;
  n = (n | n << 8) & 0x100f00f00f00f00fULL;
  n = (n | n << 4) & 0x10c30c30c30c30c3ULL;
  return (n | n << 2) & 0x1249249249249249ULL;
}

std::vector<std::uint64_t> morton_codes(const std::vector<Vec3>& nodes) {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();
  if (!nodes.empty()) low = high = nodes.front();
  for (const Vec3& x : nodes) low = low.cwiseMin(x), high = high.cwiseMax(x);
  const double size = (high - low).maxCoeff();
  const double scale = size > 0 ? ((1 << bits_an_axis) - 1) / size : 0;
  std::vector<std::uint64_t> codes;
  codes.reserve(nodes.size());
  for (const Vec3& x : nodes) {
    std::uint64_t code = 0;
    for (int a = 0; a < 3; ++a) code |= spread(static_cast<std::uint64_t>((x - low)[a] * scale)) << a;
    codes.push_back(code);
  }
  return codes;
}

template <class T>
void put_in_order(std::vector<T>& entries, const std::vector<Index>& order) {
  std::vector<T> sorted;
  sorted.reserve(entries.size());
  for (const Index n : order) sorted.push_back(entries[static_cast<std::size_t>(n)]);
  entries = std::move(sorted);
}

}  // namespace

std::vector<Index> renumber(TetMesh& mesh) {
  const auto codes = morton_codes(mesh.nodes);
  std::vector<Index> order(mesh.nodes.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](Index n) { return codes[static_cast<std::size_t>(n)]; });
  std::vector<Index> number(order.size());
  for (std::size_t n = 0; n < order.size(); ++n)
    number[static_cast<std::size_t>(order[n])] = static_cast<Index>(n);
  put_in_order(mesh.nodes, order);
  for (auto& corners : mesh.tets)
    for (Index& node : corners) node = number[static_cast<std::size_t>(node)];
  for (auto& middles : mesh.middles)
    for (Index& node : middles) node = number[static_cast<std::size_t>(node)];

  std::vector<Index> tets(mesh.tets.size());
  std::iota(tets.begin(), tets.end(), 0);
  std::ranges::stable_sort(tets, {}, [&](Index t) {
    auto sorted = mesh.tets[static_cast<std::size_t>(t)];
    std::ranges::sort(sorted);
    return std::tuple(mesh.region[static_cast<std::size_t>(t)], sorted);
  });
  put_in_order(mesh.tets, tets);
  put_in_order(mesh.region, tets);
  if (!mesh.middles.empty()) put_in_order(mesh.middles, tets);
  return order;
}

}  // namespace palpate::physics
