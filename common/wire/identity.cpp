#include "common/wire/identity.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <charconv>
#include <filesystem>
#include <vector>

#include "common/message/messages.h"
#include "common/report/commit.h"
#include "common/wire/convert.h"

namespace palpate {
namespace {

constexpr std::string_view mark = "palpate-1";
constexpr std::size_t most = 1024;  // bytes of a text that is looked at
constexpr std::size_t n_words = 8;

/// One word on the wire: no space or control character in it, and not without end.
std::string word(std::string text) {
  for (char& letter : text)
    if (letter <= ' ' || letter == '\x7f') letter = '_';
  text.resize(std::min<std::size_t>(text.size(), 100));
  return text.empty() ? "-" : text;
}

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> words;
  while (!text.empty() && words.size() <= n_words) {
    const auto end = std::min(text.find(' '), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

template <class N>
bool number(std::string_view text, N& value, int base = 10) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  return error == std::errc() && end == text.data() + text.size();
}

}  // namespace

Identity own_identity(const std::string& role, const std::string& scene_path, std::uint64_t checksum) {
  std::array<char, 65> host = {};
  gethostname(host.data(), host.size() - 1);
  return {.role = role,
          .wire = wire_version,
          .commit = commit(),
          .scene = std::filesystem::path(scene_path).stem().string(),
          .checksum = checksum,
          .host = word(host.data()),
          .pid = static_cast<std::uint32_t>(getpid())};
}

std::string to_text(const Identity& identity) {
  return fmt::format("{} {} {} {} {} {:x} {} {}", mark, word(identity.role), identity.wire,
                     word(identity.commit), word(identity.scene), identity.checksum, word(identity.host),
                     identity.pid);
}

std::optional<Identity> identity_from(std::string_view text) {
  if (text.size() > most) return {};
  for (const char letter : text)
    if (letter < ' ' || letter == '\x7f') return {};
  const auto words = split(text);
  if (words.size() != n_words || words[0] != mark) return {};
  Identity identity;
  if (!number(words[2], identity.wire) || !number(words[5], identity.checksum, 16) ||
      !number(words[7], identity.pid))
    return {};
  identity.role = words[1];
  identity.commit = words[3];
  identity.scene = words[4];
  identity.host = words[6];
  return identity;
}

std::string difference(const Identity& own, const Identity& other) {
  const std::string who = fmt::format("{} on {}", other.role, other.host);
  if (other.wire != own.wire)
    return fmt::format("{} speaks wire version {}, this palpate {}; install the same version on both PCs",
                       who, other.wire, own.wire);
  if (other.commit != own.commit)
    return fmt::format("{} is of commit {}, this palpate of {}; install the same version on both PCs", who,
                       other.commit, own.commit);
  if (other.scene != word(own.scene))
    return fmt::format(
        "{} runs the scene {}, this PC {}; give both the same one, or this session another --domain", who,
        other.scene, own.scene);
  if (other.checksum != own.checksum)
    return fmt::format(
        "{} has another text of the scene {} (checksum {:x}, here {:x}); copy the file, and give both "
        "the same --set",
        who, own.scene, other.checksum, own.checksum);
  return {};
}

}  // namespace palpate
