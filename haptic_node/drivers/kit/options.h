#pragma once
// The keys and values that a scene gives to its driver. Every key is asked for once; a key that nobody asked for is a
// mistake that names those that were.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace palpate::haptic::kit {

class Options {
 public:
  /// @param kv  2 n_kv texts: key, value, ...
  Options(const char* const* kv, std::uint32_t n_kv);

  /// The value of `key`, or `fallback`. Throws Trouble (HDEV_E_ARG) if it is not what the name says. @{
  std::string text(const std::string& key, const std::string& fallback);
  double positive(const std::string& key, double fallback);
  double number(const std::string& key, double fallback);
  std::uint32_t whole(const std::string& key, std::uint32_t fallback, std::uint32_t most);
  bool yes(const std::string& key, bool fallback);
  std::vector<double> numbers(const std::string& key, std::size_t n);  // between blanks; empty if not given
  /// @}

  /// After the last question. Throws Trouble for a key that nobody asked for.
  void refuse_rest() const;

 private:
  const std::string* find(const std::string& key);
  std::vector<std::pair<std::string, std::string>> given_;
  std::vector<std::string> asked_;
};

/// A finite number that fills all of `text`. @return false otherwise
bool read_number(const std::string& text, double& value);

}  // namespace palpate::haptic::kit
