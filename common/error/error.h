#pragma once
// The three kinds of trouble and who handles them (docs/architecture.md, "Errors").
//
//   a person's mistake         throw InputError while loading; main() prints its lines and exits with 2
//   trouble while running      a value and a counter; never an exception inside a tick
//   a bug of ours              PALPATE_CHECK: says where and aborts

#include <stdexcept>
#include <string>
#include <vector>

namespace palpate {

inline constexpr int exit_ok = 0;
inline constexpr int exit_failed = 1;   // something failed while running
inline constexpr int exit_mistake = 2;  // the person's mistake: one line each on stderr, nothing written over

/// One or more mistakes in what a person gave. Each complaint is one line: "where: what; what would be right".
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::string complaint);
  explicit InputError(std::vector<std::string> complaints);
  const std::vector<std::string>& complaints() const noexcept { return complaints_; }

 private:
  std::vector<std::string> complaints_;
};

/// Prints "file:line: check failed: condition (note)" and aborts.
[[noreturn]] void check_failed(const char* condition, const char* file, int line, const char* note) noexcept;

}  // namespace palpate

/// A condition that only a bug of ours can break. Always on; not for kernels.
#define PALPATE_CHECK(condition, note) \
  ((condition) ? static_cast<void>(0) : ::palpate::check_failed(#condition, __FILE__, __LINE__, note))
