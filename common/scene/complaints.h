#pragma once
// The mistakes found in one scene, gathered so that a person sees all of them at once.

#include <string>
#include <vector>

#include "common/scene/place.h"

namespace palpate {

class Complaints {
 public:
  enum class Kind { unknown_key, other };

  /// @param where  of the mistake
  /// @param table  where the table that holds it begins, nowhere for the whole file; its mistakes stay together
  /// @param what   "what; what would be right"; control characters are replaced, so that it stays one line
  void add(const Place& where, const Place& table, const std::string& what, Kind kind = Kind::other);

  /// Tables in the order of the file; within one, unknown keys first (they explain the missing ones).
  /// @throws InputError if there is any complaint
  void throw_if_any() const;

 private:
  struct Complaint {
    Place where, table;
    std::string what;
    Kind kind;
  };
  std::vector<Complaint> complaints_;
};

/// Text without control characters, cut at a sensible length.
std::string one_line(const std::string& text);

}  // namespace palpate
