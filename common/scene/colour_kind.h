#pragma once
// What the colours of tissue say.

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace palpate {

/// own: what it looks like. displacement: how far it is from where it lies at rest. strain: how much it is out of
/// shape. stress: von Mises'. pressure: how hard it is pressed together from all sides. awake: 1 where it is
/// stepped, 0 where it sleeps. Physics computes the last four (tissue_field.h), the eye the others.
enum class ColourKind : std::uint8_t { own, displacement, strain, stress, pressure, awake };
inline constexpr std::array<std::string_view, 6> colour_names = {"own",    "displacement", "strain",
                                                                 "stress", "pressure",     "awake"};

constexpr std::string_view name_of(ColourKind kind) noexcept {
  return colour_names[static_cast<std::size_t>(kind)];
}
constexpr std::optional<ColourKind> colour_kind_of(std::string_view name) noexcept {
  for (std::size_t n = 0; n < colour_names.size(); ++n)
    if (colour_names[n] == name) return static_cast<ColourKind>(n);
  return std::nullopt;
}
constexpr ColourKind next(ColourKind kind) noexcept {
  return static_cast<ColourKind>((static_cast<std::size_t>(kind) + 1) % colour_names.size());
}
/// Does it need numbers from physics?
constexpr bool is_of_physics(ColourKind kind) noexcept { return kind >= ColourKind::strain; }

}  // namespace palpate
