#pragma once
// What the colours of tissue say that show how far it is from where it lies at rest, how it strains, what stress or
// pressure is in it or whether it is awake: from its own colour at 0 through yellow, orange and red to violet at
// `most`, a round number that only grows,
// so that a colour keeps its meaning while one looks.

#include <array>
#include <cstdint>
#include <string>

#include "common/scene/colour_kind.h"

namespace palpate::render {

class ColourScale {
 public:
  /// Another kind begins anew, at its least.
  void show(ColourKind kind) noexcept;
  ColourKind kind() const noexcept { return kind_; }
  /// Somewhere in the tissue it is so much. [m], strain, [Pa]
  void see(double value) noexcept;
  double most() const noexcept {
    return most_;
  }                           // 1, 2 or 5 times a power of ten; at least the least of the kind
  std::string words() const;  // "20 mm", "10 %", "5 kPa", "awake"
  const char* least_words() const noexcept { return kind_ == ColourKind::awake ? "asleep" : "0"; }
  const char* heading() const;  // "from rest"

  /// Of equal steps from 0 to most, as shown; the first stands for the tissue's own.
  static constexpr std::array<std::array<std::uint8_t, 3>, 5> colours = {
      {{{214, 208, 200}}, {{255, 219, 77}}, {{245, 128, 31}}, {{199, 31, 41}}, {{102, 15, 117}}}};
  /// Why: less is not a dent that one sees, nor a strain that one feels. [m], strain, [Pa]
  static constexpr std::array<double, colour_names.size()> least = {1, 1e-3, 0.01, 100, 100, 1};

 private:
  ColourKind kind_ = ColourKind::displacement;
  double most_ = least[static_cast<std::size_t>(ColourKind::displacement)];
};

}  // namespace palpate::render
