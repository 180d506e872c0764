#include <array>
#include <cstddef>
#include <vector>

#include "physics_node/body/cells.h"

namespace palpate::physics {
namespace {

constexpr std::array<std::array<int, 3>, 6> faces{
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

/// Labels everything that is 6-connected to `start`. @return how many cells that is
std::size_t flood(const Cells& cells, std::size_t start, std::uint32_t label,
                  std::vector<std::uint32_t>& labels, std::vector<std::size_t>& stack) {
  const auto nx = static_cast<std::size_t>(cells.size.x());
  const auto ny = static_cast<std::size_t>(cells.size.y());
  std::size_t count = 0;
  stack.assign(1, start);
  labels[start] = label;
  while (!stack.empty()) {
    const std::size_t n = stack.back();
    stack.pop_back();
    ++count;
    const int i = static_cast<int>(n % nx);
    const int j = static_cast<int>(n / nx % ny);
    const int k = static_cast<int>(n / nx / ny);
    for (const auto& face : faces) {
      if (!cells.is_filled(i + face[0], j + face[1], k + face[2])) continue;
      const std::size_t next = cells.index(i + face[0], j + face[1], k + face[2]);
      if (labels[next] != 0) continue;
      labels[next] = label;
      stack.push_back(next);
    }
  }
  return count;
}

}  // namespace

int keep_largest_component(Cells& cells) {
  std::vector<std::uint32_t> labels(cells.filled.size(), 0);
  std::vector<std::size_t> stack;
  std::uint32_t n_labels = 0;
  std::uint32_t largest = 0;
  std::size_t largest_count = 0;
  for (std::size_t n = 0; n < cells.filled.size(); ++n) {
    if (cells.filled[n] == 0 || labels[n] != 0) continue;
    const std::size_t count = flood(cells, n, ++n_labels, labels, stack);
    if (count > largest_count) {
      largest_count = count;
      largest = n_labels;
    }
  }
  for (std::size_t n = 0; n < cells.filled.size(); ++n)
    cells.filled[n] = labels[n] == largest && largest != 0 ? 1 : 0;
  return static_cast<int>(n_labels);
}

int n_pieces(const Cells& cells) {
  std::vector<std::uint32_t> labels(cells.filled.size(), 0);
  std::vector<std::size_t> stack;
  std::uint32_t n_labels = 0;
  for (std::size_t n = 0; n < cells.filled.size(); ++n)
    if (cells.filled[n] != 0 && labels[n] == 0) flood(cells, n, ++n_labels, labels, stack);
  return static_cast<int>(n_labels);
}

}  // namespace palpate::physics
