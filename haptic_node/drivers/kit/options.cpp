#include "haptic_node/drivers/kit/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "haptic_node/drivers/kit/driver.h"

namespace palpate::haptic::kit {
namespace {

[[noreturn]] void refuse(const std::string& key, const std::string& value, const char* wanted) {
  throw Trouble(HDEV_E_ARG, fmt::format("{} is \"{}\"; {} is wanted", key, value, wanted));
}

}  // namespace

bool read_number(const std::string& text, double& value) {
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && std::isfinite(value);
}

Options::Options(const char* const* kv, std::uint32_t n_kv) {
  for (std::uint32_t i = 0; i < n_kv; ++i) given_.emplace_back(kv[2 * i], kv[2 * i + 1]);
}

const std::string* Options::find(const std::string& key) {
  asked_.push_back(key);
  for (const auto& [name, value] : given_)
    if (name == key) return &value;
  return nullptr;
}

std::string Options::text(const std::string& key, const std::string& fallback) {
  const std::string* value = find(key);
  if (value != nullptr && value->empty()) refuse(key, *value, "a text");
  return value == nullptr ? fallback : *value;
}

double Options::number(const std::string& key, double fallback) {
  const std::string* value = find(key);
  if (value != nullptr && !read_number(*value, fallback)) refuse(key, *value, "a number");
  return fallback;
}

double Options::positive(const std::string& key, double fallback) {
  const std::string* value = find(key);
  if (value != nullptr && !(read_number(*value, fallback) && fallback > 0))
    refuse(key, *value, "a number above 0");
  return fallback;
}

std::uint32_t Options::whole(const std::string& key, std::uint32_t fallback, std::uint32_t most) {
  const std::string* value = find(key);
  if (value == nullptr) return fallback;
  double number = 0;
  if (!read_number(*value, number) || number < 0 || number > most || number != std::floor(number))
    refuse(key, *value, fmt::format("a whole number from 0 to {}", most).c_str());
  return static_cast<std::uint32_t>(number);
}

bool Options::yes(const std::string& key, bool fallback) {
  const std::string* value = find(key);
  if (value == nullptr) return fallback;
  if (*value != "true" && *value != "false") refuse(key, *value, "true or false");
  return *value == "true";
}

std::vector<double> Options::numbers(const std::string& key, std::size_t n) {
  const std::string* value = find(key);
  std::vector<double> numbers;
  if (value == nullptr) return numbers;
  std::istringstream words(*value);
  bool good = true;
  for (std::string word; good && words >> word;) {
    numbers.push_back(0);
    good = read_number(word, numbers.back());
  }
  if (!good || numbers.size() != n) refuse(key, *value, fmt::format("{} numbers between blanks", n).c_str());
  return numbers;
}

void Options::refuse_rest() const {
  for (const auto& [key, value] : given_) {
    if (std::find(asked_.begin(), asked_.end(), key) != asked_.end()) continue;
    throw Trouble(HDEV_E_ARG, fmt::format("unknown key \"{}\"; known are {}", key, fmt::join(asked_, ", ")));
  }
}

}  // namespace palpate::haptic::kit
