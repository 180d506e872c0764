#include "common/wire/shared_memory.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cctype>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <vector>

namespace palpate {
namespace {

namespace fs = std::filesystem;
// Source: iceoryx 2.0, platform_settings.hpp and ipc_interface_base.hpp: the socket's folder and RouDi's name.
constexpr const char* roudi_address = "/tmp/roudi";
constexpr std::string_view roudi_program = "iox-roudi";

/// The command line of the program `iox-roudi` if it runs.
std::optional<std::vector<std::string>> roudi_command() {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator("/proc", error)) {
    if (std::isdigit(static_cast<unsigned char>(entry.path().filename().string().front())) == 0) continue;
    std::ifstream file(entry.path() / "cmdline");
    std::vector<std::string> command;
    for (std::string word; std::getline(file, word, '\0');) command.push_back(word);
    if (!command.empty() && fs::path(command.front()).filename() == roudi_program) return command;
  }
  return {};
}

bool watches(const std::vector<std::string>& command) {
  for (std::size_t i = 1; i < command.size(); ++i) {
    const std::string& word = command[i];
    if (word == "--monitoring-mode=off" || word == "-moff") return false;
    if ((word == "-m" || word == "--monitoring-mode") && i + 1 < command.size())
      return command[i + 1] != "off";
  }
  return true;
}

}  // namespace

/// Connecting a datagram socket sends nothing; it fails where nobody listens or we may not write.
bool roudi_listens() {
  const int descriptor = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) return false;
  sockaddr_un to = {};
  to.sun_family = AF_UNIX;
  std::strncpy(to.sun_path, roudi_address, sizeof to.sun_path - 1);
  const bool answers = connect(descriptor, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
  close(descriptor);
  return answers;
}

RouDi look_for_roudi() {
  const char* wish = std::getenv("PALPATE_SHARED_MEMORY");
  if (wish != nullptr && std::string_view(wish) == "off") return RouDi::refused;
  const auto command = roudi_command();
  if (!roudi_listens()) return command ? RouDi::unreachable : RouDi::absent;
  return !command || watches(*command) ? RouDi::watching : RouDi::ready;
}

std::string words(RouDi found) {
  switch (found) {
    case RouDi::absent:
      return "RouDi is not running; messages go over UDP loopback";
    case RouDi::unreachable:
      return "RouDi runs, but not for this process (another user, or a private /tmp); messages go over UDP "
             "loopback";
    case RouDi::watching:
      return "RouDi runs, but it would abort a node that stands still for 1.5 s; messages go over UDP "
             "loopback. Start "
             "it with --monitoring-mode off";
    case RouDi::ready:
      return "RouDi runs; vertex blocks go through shared memory, all else over UDP loopback";
    case RouDi::refused:
      return "PALPATE_SHARED_MEMORY=off; messages go over UDP loopback";
  }
  return "unknown";
}

std::string with_shared_memory(std::string_view config) {
  constexpr std::string_view element =
      "    <SharedMemory><Enable>true</Enable><LogLevel>error</LogLevel></SharedMemory>\n";
  std::string text(config);
  text.insert(text.find("  </Domain>"), element);
  return text;
}

}  // namespace palpate
