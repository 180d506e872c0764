#pragma once
// What has happened to the elements of a mass.

#include <cstdint>

namespace palpate::physics {

inline constexpr std::uint8_t mass_yielded = 1;  // an element of this mass has yielded
inline constexpr std::uint8_t mass_broken = 2;   // an element of this mass has broken

}  // namespace palpate::physics
