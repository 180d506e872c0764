#include "common/error/error.h"

#include <cstdio>
#include <cstdlib>

namespace palpate {
namespace {

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const auto& line : lines) text += text.empty() ? line : "\n" + line;
  return text;
}

}  // namespace

InputError::InputError(std::string complaint) : InputError(std::vector<std::string>{std::move(complaint)}) {}

InputError::InputError(std::vector<std::string> complaints)
    : std::runtime_error(joined(complaints)), complaints_(std::move(complaints)) {}

void check_failed(const char* condition, const char* file, int line, const char* note) noexcept {
  std::fprintf(stderr, "%s:%d: check failed: %s (%s)\n", file, line, condition, note);
  std::abort();
}

}  // namespace palpate
