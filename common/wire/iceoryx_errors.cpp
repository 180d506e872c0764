#include <cstdio>
#include <iostream>
#include <mutex>
#include <streambuf>
#include <string>

#include "common/time/clock.h"
#include "common/wire/shared_memory.h"

namespace palpate {
namespace {

constexpr std::int64_t period_ns = 1'000'000'000;
constexpr std::size_t most_letters = 200;

/// Takes the place of std::cerr's buffer. Whoever writes in pieces from several threads gets mixed lines, as before.
class TamedErrors : public std::streambuf {
 protected:
  int_type overflow(int_type letter) override {
    const char c = traits_type::to_char_type(letter);
    add({&c, 1});
    return traits_type::not_eof(letter);
  }
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    add({text, static_cast<std::size_t>(size)});
    return size;
  }

 private:
  void add(std::string_view text) {
    const std::lock_guard lock(mutex_);
    for (const char c : text) {
      if (c == '\n')
        end_line();
      else if (line_.size() < most_letters && (c >= ' ' || c == '\t'))
        line_ += c;
    }
  }
  void end_line() {
    const std::int64_t now = now_ns();
    if (!line_.empty() && now - last_ns_ >= period_ns) {
      // Not through our log: iceoryx still speaks when the program's own objects have gone.
      std::fprintf(stderr, "iceoryx: %s\n", line_.c_str());
      last_ns_ = now;
    }
    line_.clear();
  }

  std::mutex mutex_;
  std::string line_;
  std::int64_t last_ns_ = -period_ns;
};

}  // namespace

void tame_iceoryx_errors() {
  static auto* tamed = new TamedErrors;  // never freed: std::cerr may be written to until the very end
  static std::once_flag once;
  std::call_once(once, [] { std::cerr.rdbuf(tamed); });
}

}  // namespace palpate
