// Faults on purpose, one a program: the sanitizer must name each and end it. Without them, a build that watches nothing
// would pass.

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <vector>

namespace palpate::test {
namespace {

/// Values that no compiler knows beforehand.
template <class T>
T unknown(T value) {
  volatile T hidden = value;
  return hidden;
}

double beyond_the_end() {
  const std::vector<double> numbers(unknown<std::size_t>(4));
  return numbers.data()[unknown<std::size_t>(4)];
}

double after_its_end() {
  auto* numbers = new double[unknown<std::size_t>(4)]();
  delete[] numbers;
  return unknown(numbers)[1];
}

int more_than_the_most() { return unknown(std::numeric_limits<int>::max()) + unknown(1); }

int shifted_too_far() { return 1 << unknown(40); }

double a_number_that_no_int_holds() { return static_cast<int>(unknown(1e12)); }

TEST(AddressSanitizer, SeesAReadBeyondTheEnd) {
  EXPECT_DEATH(std::exit(beyond_the_end() > 0), "heap-buffer-overflow");
}
TEST(AddressSanitizer, SeesAReadAfterTheEnd) {
  EXPECT_DEATH(std::exit(after_its_end() > 0), "heap-use-after-free");
}
TEST(UndefinedBehaviourSanitizer, SeesASumThatOverflows) {
  EXPECT_DEATH(std::exit(more_than_the_most() > 0), "signed integer overflow");
}
TEST(UndefinedBehaviourSanitizer, SeesAShiftThatIsTooLong) {
  EXPECT_DEATH(std::exit(shifted_too_far() > 0), "shift exponent");
}
TEST(UndefinedBehaviourSanitizer, SeesAConversionThatDoesNotFit) {
  EXPECT_DEATH(std::exit(a_number_that_no_int_holds() > 0), "outside the range of representable values");
}

}  // namespace
}  // namespace palpate::test
