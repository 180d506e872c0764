#define TOML_IMPLEMENTATION  // the one place that compiles the parser
#include "common/scene/toml_text.h"

#include <optional>

#include "common/error/error.h"
#include "common/math/vec3.h"
#include "common/scene/complaints.h"

namespace palpate {
namespace {

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; }

bool confuses(std::string_view text) {
  try {
    const auto table = toml::parse(text);
    return false;
  } catch (const ParserAtALoss&) {
    return true;
  } catch (const toml::parse_error&) {
    return false;
  }
}

/// Length of the shortest beginning that confuses the parser, which reads forward only: found by halving.
std::size_t shortest_confusing(std::string_view text) {
  std::size_t fine = 0, confusing = text.size();
  while (fine + 1 < confusing) {
    auto middle = fine + (confusing - fine) / 2;
    while (middle < confusing && continues_character(text[middle])) ++middle;
    if (middle == confusing) break;
    (confuses(text.substr(0, middle)) ? confusing : fine) = middle;
  }
  return confusing;
}

/// Columns count characters, not bytes.
Place place_at(std::string_view text, std::size_t offset, const std::string& file) {
  Place place{file, 1, 1};
  for (const char c : text.substr(0, offset)) {
    place.column = c == '\n' ? 1 : place.column + (continues_character(c) ? 0 : 1);
    place.line += c == '\n' ? 1 : 0;
  }
  return place;
}

/// Offset of a dotted key that would nest tables deeper than any scene does: the parser recurses as deep as a key says.
/// Counted are single dots between separators, wherever they stand.
std::optional<std::size_t> too_deep(std::string_view text) {
  constexpr int deepest = 64;
  int dots = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool alone = (i == 0 || text[i - 1] != '.') && (i + 1 == text.size() || text[i + 1] != '.');
    if (text[i] == '.' && alone && ++dots > deepest) return i;
    if (std::string_view(",={}[]\n").find(text[i]) != std::string_view::npos) dots = 0;
  }
  return std::nullopt;
}

}  // namespace

toml::table table_of_text(std::string_view text, const std::string& name) {
  constexpr std::string_view verbose = "Error while parsing ";
  constexpr auto advice = "; correct this first, the rest is read after it";
  if (const auto offset = too_deep(text))
    throw InputError(place_at(text, *offset, name).text() +
                     ": a key of too many parts; scenes have three levels");
  try {
    return toml::parse(text, std::string_view(name));
  } catch (const toml::parse_error& error) {
    const auto& begin = error.source().begin;
    const Place place{name, static_cast<int>(begin.line), static_cast<int>(begin.column)};
    std::string what(error.description());
    if (what.starts_with(verbose)) what = "not TOML, in " + what.substr(verbose.size());
    const bool twice = what.find("redefine") != what.npos;
    throw InputError(place.text() + ": " + one_line(what) + (twice ? "; write each key once" : advice));
  } catch (const ParserAtALoss&) {
    const auto place = place_at(text, shortest_confusing(text) - 1, name);
    throw InputError(place.text() + ": a name, key or value is missing here" + advice);
  }
}

}  // namespace palpate
