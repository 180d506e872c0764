#pragma once
// Any plain struct as lines "member.member = value", found by the compiler: a member that is added to it is in there, too.
// Members are called by their number. A test compares two structs with it without knowing their members.

#include <fmt/format.h>

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "common/scene/body_spec.h"
#include "common/scene/connection_spec.h"
#include "common/scene/device_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/physics_spec.h"
#include "common/scene/record_spec.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "common/scene/surroundings_spec.h"
#include "common/scene/tool_spec.h"

namespace palpate::test {

using Lines = std::map<std::string, std::string>;  // value by path

/// Whose members are listed one by one.
template <class T>
concept Listed = std::is_aggregate_v<T> || std::is_same_v<T, Scene>;

/// As many as can be given, each as {}: a struct takes no more than it has.
template <class T>
constexpr std::size_t n_members() {
  if constexpr (requires {
                  T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}};
                })
    return 22;
  else if constexpr (requires {
                       T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}};
                     })
    return 21;
  else if constexpr (requires {
                       T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}};
                     })
    return 20;
  else if constexpr (requires {
                       T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}};
                     })
    return 19;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; })
    return 18;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; })
    return 17;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; })
    return 16;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; })
    return 15;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; })
    return 14;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; })
    return 13;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; })
    return 12;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; })
    return 11;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}, {}}; })
    return 10;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}, {}}; })
    return 9;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}, {}}; })
    return 8;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}, {}}; })
    return 7;
  else if constexpr (requires { T{{}, {}, {}, {}, {}, {}}; })
    return 6;
  else if constexpr (requires { T{{}, {}, {}, {}, {}}; })
    return 5;
  else if constexpr (requires { T{{}, {}, {}, {}}; })
    return 4;
  else if constexpr (requires { T{{}, {}, {}}; })
    return 3;
  else if constexpr (requires { T{{}, {}}; })
    return 2;
  else if constexpr (requires { T{{}}; })
    return 1;
  else
    return 0;
}

/// A scene has constructors, so that nobody can count its members; a number that is wrong does not compile.
template <>
constexpr std::size_t n_members<Scene>() {
  return 17;
}

/// use(member...) for each of up to 22 members.
template <class T, class Use>
void with_members(const T& x, Use use) {
  constexpr std::size_t n = n_members<T>();
  static_assert(n >= 1 && n <= 22, "more members than are named here");
  if constexpr (n == 1) {
    const auto& [a] = x;
    use(a);
  }
  if constexpr (n == 2) {
    const auto& [a, b] = x;
    use(a, b);
  }
  if constexpr (n == 3) {
    const auto& [a, b, c] = x;
    use(a, b, c);
  }
  if constexpr (n == 4) {
    const auto& [a, b, c, d] = x;
    use(a, b, c, d);
  }
  if constexpr (n == 5) {
    const auto& [a, b, c, d, e] = x;
    use(a, b, c, d, e);
  }
  if constexpr (n == 6) {
    const auto& [a, b, c, d, e, f] = x;
    use(a, b, c, d, e, f);
  }
  if constexpr (n == 7) {
    const auto& [a, b, c, d, e, f, g] = x;
    use(a, b, c, d, e, f, g);
  }
  if constexpr (n == 8) {
    const auto& [a, b, c, d, e, f, g, h] = x;
    use(a, b, c, d, e, f, g, h);
  }
  if constexpr (n == 9) {
    const auto& [a, b, c, d, e, f, g, h, i] = x;
    use(a, b, c, d, e, f, g, h, i);
  }
  if constexpr (n == 10) {
    const auto& [a, b, c, d, e, f, g, h, i, j] = x;
    use(a, b, c, d, e, f, g, h, i, j);
  }
  if constexpr (n == 11) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k] = x;
    use(a, b, c, d, e, f, g, h, i, j, k);
  }
  if constexpr (n == 12) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l] = x;
    use(a, b, c, d, e, f, g, h, i, j, k, l);
  }
  if constexpr (n == 13) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = x;
    use(a, b, c, d, e, f, g, h, i, j, k, l, m);
  }
  if constexpr (n == 14) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o] = x;
    use(a, b, c, d, e, f, g, h, i, j, k, l, m, o);
  }
  if constexpr (n == 15) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p] = x;
    use(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p);
  }
  if constexpr (n == 16) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q] = x;
    use(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q);
  }
  if constexpr (n == 17) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r] = x;
    use(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r);
  }
  if constexpr (n == 18) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s] = x;
    use(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s);
  }
  if constexpr (n == 19) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s, t] = x;
    use(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s, t);
  }
  if constexpr (n == 20) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s, t, u] = x;
    use(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s, t, u);
  }
  if constexpr (n == 21) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s, t, u, v] = x;
    use(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s, t, u, v);
  }
  if constexpr (n == 22) {
    const auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s, t, u, v, w] = x;
    use(a, b, c, d, e, f, g, h, i, j, k, l, m, o, p, q, r, s, t, u, v, w);
  }
}

/// Numbers have four digits, so that a page may round them. Places in files are left out.
inline void add_lines(Lines&, const std::string&, const Place&) {}
inline void add_lines(Lines& lines, const std::string& at, const std::string& x) {
  lines[at] = x.empty() ? "none" : x;
}
/// Options, by their names.
inline void add_lines(Lines& lines, const std::string& at,
                      const std::vector<std::pair<std::string, std::string>>& x) {
  for (const auto& [key, value] : x) lines[at + "." + key] = value;
}
template <class T>
requires std::is_arithmetic_v<T>
void add_lines(Lines& lines, const std::string& at, T x) {
  lines[at] = fmt::format("{:.4g}", static_cast<double>(x));
}
template <class T>
requires std::is_enum_v<T>
void add_lines(Lines& lines, const std::string& at, T x) {
  lines[at] = fmt::format("word {}", static_cast<int>(x));
}
template <int R, int C>
void add_lines(Lines& lines, const std::string& at, const Eigen::Matrix<double, R, C>& x) {
  for (Eigen::Index i = 0; i < x.size(); ++i)
    lines[fmt::format("{}[{}]", at, i)] = fmt::format("{:.4g}", x.data()[i] + 0.0);
}
template <class T>
void add_lines(Lines& lines, const std::string& at, const std::optional<T>& x);
template <class T>
void add_lines(Lines& lines, const std::string& at, const Indirect<T>& x);
template <class T>
void add_lines(Lines& lines, const std::string& at, const std::vector<T>& x);
template <class T, std::size_t N>
void add_lines(Lines& lines, const std::string& at, const std::array<T, N>& x);
template <class... T>
void add_lines(Lines& lines, const std::string& at, const std::variant<T...>& x);

template <Listed T>
void add_lines(Lines& lines, const std::string& at, const T& x) {
  with_members(x, [&](const auto&... member) {
    int n = 0;
    (add_lines(lines, fmt::format("{}.{}", at, n++), member), ...);
  });
}
template <class T>
void add_lines(Lines& lines, const std::string& at, const std::optional<T>& x) {
  lines[at + "?"] = x ? "there" : "none";
  if (x) add_lines(lines, at, *x);
}
template <class T>
void add_lines(Lines& lines, const std::string& at, const Indirect<T>& x) {
  add_lines(lines, at, *x);
}
template <class T>
void add_lines(Lines& lines, const std::string& at, const std::vector<T>& x) {
  lines[at + "#"] = x.empty() ? "none" : fmt::format("{}", x.size());
  for (std::size_t i = 0; i < x.size(); ++i) add_lines(lines, fmt::format("{}[{}]", at, i), x[i]);
}
template <class T, std::size_t N>
void add_lines(Lines& lines, const std::string& at, const std::array<T, N>& x) {
  for (std::size_t i = 0; i < N; ++i) add_lines(lines, fmt::format("{}[{}]", at, i), x[i]);
}
template <class... T>
void add_lines(Lines& lines, const std::string& at, const std::variant<T...>& x) {
  lines[at + "|"] = fmt::format("kind {}", x.index());
  std::visit([&](const auto& y) { add_lines(lines, at, y); }, x);
}

template <class T>
Lines lines_of(const T& x) {
  Lines lines;
  add_lines(lines, "", x);
  return lines;
}

}  // namespace palpate::test
