#include "common/report/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <string>

namespace palpate {
namespace {

const auto start = std::chrono::steady_clock::now();

std::string& log_name() {
  static std::string name = "palpate";
  return name;
}

spdlog::logger& logger() {
  static const auto instance = [] {
    auto made =
        std::make_shared<spdlog::logger>("palpate", std::make_shared<spdlog::sinks::stderr_sink_mt>());
    made->set_pattern("%v");
    made->flush_on(spdlog::level::info);
    return made;
  }();
  return *instance;
}

}  // namespace

void set_log_name(std::string_view name) { log_name() = name; }

void log_line(LogLevel level, std::string_view text) {
  constexpr std::array words = {"info ", "warn ", "error"};
  constexpr std::array levels = {spdlog::level::info, spdlog::level::warn, spdlog::level::err};
  const auto which = static_cast<std::size_t>(level);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  logger().log(levels[which], "{:8.3f} {} {} {}", seconds, log_name(), words[which], text);
}

}  // namespace palpate
