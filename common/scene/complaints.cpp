#include "common/scene/complaints.h"

#include <algorithm>
#include <tuple>

#include "common/error/error.h"

namespace palpate {

std::string one_line(const std::string& text) {
  constexpr std::size_t longest =
      500;  // Why: the longest list of known keys, of a needle that is a body, takes 430
  std::string line;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    line += code < 0x20 || code == 0x7f ? ' ' : c;
  }
  if (line.size() <= longest) return line;
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(line[end]) & 0xc0) == 0x80) --end;  // not within a character
  return line.substr(0, end) + "...";
}

void Complaints::add(const Place& where, const Place& table, const std::string& what, Kind kind) {
  complaints_.push_back({where, table, one_line(what), kind});
}

void Complaints::throw_if_any() const {
  if (complaints_.empty()) return;
  auto sorted = complaints_;
  const auto rank = [](const Complaint& c) {
    return std::tuple(c.table.line, c.table.column, c.kind, c.where.line, c.where.column);
  };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&rank](const Complaint& a, const Complaint& b) { return rank(a) < rank(b); });
  std::vector<std::string> lines;
  for (const auto& complaint : sorted) lines.push_back(complaint.where.text() + ": " + complaint.what);
  throw InputError(std::move(lines));
}

}  // namespace palpate
