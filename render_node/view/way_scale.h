#pragma once
// What the colours say that show how far tissue is from where it lies at rest: from its own colour at 0 through
// yellow, orange and red to violet at `most`, a round length that only grows, so that a colour keeps its meaning
// while one looks.

#include <array>
#include <cstdint>
#include <string>

namespace palpate::render {

class WayScale {
 public:
  /// Tissue is so far from rest [m].
  void see(double way) noexcept;
  double most() const noexcept { return most_; }  // 1, 2 or 5 times a power of ten; at least `least` [m]
  std::string words() const;                      // "20 mm"

  /// Of equal steps from 0 to most, as shown; the first stands for the tissue's own.
  static constexpr std::array<std::array<std::uint8_t, 3>, 5> colours = {
      {{{214, 208, 200}}, {{255, 219, 77}}, {{245, 128, 31}}, {{199, 31, 41}}, {{102, 15, 117}}}};
  static constexpr double least = 1e-3;  // Why: less is not a dent that one sees

 private:
  double most_ = least;
};

}  // namespace palpate::render
