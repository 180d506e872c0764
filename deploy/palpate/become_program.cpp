#include "deploy/palpate/become_program.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace palpate::deploy {

void become_program(const std::filesystem::path& program, std::vector<std::string> arguments) {
  std::string name = program.string();
  std::vector<char*> argv = {name.data()};
  for (auto& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  execv(name.c_str(), argv.data());
  throw std::runtime_error(fmt::format("{} cannot be started: {}", name, std::strerror(errno)));
}

}  // namespace palpate::deploy
