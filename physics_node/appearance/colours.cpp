#include "physics_node/appearance/colours.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/scene/body_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"

namespace palpate::physics {
namespace {

constexpr std::array<std::uint32_t, 5> tints{0xFF8FA8E0, 0xFFB0C890, 0xFFD0B080, 0xFF90C8D8, 0xFFC0A0D0};
constexpr std::uint32_t steel = 0xFFD6C8BE;
constexpr double golden_section = 0.6180339887498949;

std::uint32_t packed(double r, double g, double b) {
  const auto byte = [](double value) { return static_cast<std::uint32_t>(std::lround(255 * value)); };
  return 0xFF000000U | byte(b) << 16 | byte(g) << 8 | byte(r);
}

}  // namespace

std::uint32_t body_colour(const Scene& scene, std::size_t body) {
  const bool is_tool = std::any_of(scene.tools.begin(), scene.tools.end(), [&](const ToolSpec& tool) {
    return tool.shape == ToolShape::body && tool.body == scene.bodies[body].name;
  });
  return is_tool ? steel : tints[body % tints.size()];
}

// Multiples of the golden section leave no two near labels with near hues. Every second label is paler.
std::uint32_t fragment_colour(std::int32_t label) {
  const double hue = std::fmod(label * golden_section, 1.0);
  const double pale = label % 2 == 0 ? 0.15 : 0.45;
  const auto channel = [&](double shift) {
    const double wave = std::abs(std::fmod(6 * (hue + shift), 6.0) - 3) - 1;  // HSV: 0 .. 1 over the circle
    return 0.95 * (pale + (1 - pale) * std::clamp(wave, 0.0, 1.0));
  };
  return packed(channel(0), channel(2.0 / 3), channel(1.0 / 3));
}

FragmentColours::FragmentColours(const Fragments& fragments, const Body& body)
    : label_(static_cast<std::size_t>(body.capacity()), -1) {
  body.each_node([&](Index mass) { label_[static_cast<std::size_t>(mass)] = fragments.label(mass); });
  const auto& masses = fragments.masses();
  largest_ = static_cast<Index>(std::max_element(masses.begin(), masses.end()) - masses.begin());
}

void FragmentColours::paint(Surface& surface) const {
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    const std::uint32_t corner = surface.facets[f][0];
    if (corner >= surface.n_moving()) continue;  // scenery
    const Index label = label_[static_cast<std::size_t>(surface.cell[corner])];
    if (label != largest_) surface.rgba[f] = fragment_colour(label);
  }
}

}  // namespace palpate::physics
