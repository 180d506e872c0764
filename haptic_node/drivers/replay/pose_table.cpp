#include "haptic_node/drivers/replay/pose_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>

#include "haptic_node/drivers/kit/driver.h"

namespace palpate::haptic::replay {
namespace {

struct Field {
  std::string text;  // without the blanks around it
  std::size_t column = 1;
};

constexpr const char* blanks = " \t\r";

/// Fields between commas; without any comma, between blanks.
std::vector<Field> split(const std::string& line) {
  const bool by_commas = line.find(',') != std::string::npos;
  std::vector<Field> fields;
  for (std::size_t from = 0; from <= line.size();) {
    const std::size_t begin = std::min(line.find_first_not_of(blanks, from), line.size());
    const std::size_t to = by_commas ? std::min(line.find(',', from), line.size())
                                     : std::min(line.find_first_of(blanks, begin), line.size());
    std::size_t end = to;
    while (end > begin && std::string_view(blanks).find(line[end - 1]) != std::string_view::npos) --end;
    if (by_commas || end > begin) fields.push_back({line.substr(begin, end - begin), begin + 1});
    from = to + 1;
  }
  return fields;
}

class TableFile {
 public:
  explicit TableFile(const std::string& name) : name_(name), file_(name) {
    if (!file_)
      throw kit::Trouble(HDEV_E_ARG,
                         fmt::format("{}: {}; name a table of poses", name, std::strerror(errno)));
  }
  /// The next line that says something.
  bool next(std::string& line) {
    while (std::getline(file_, line)) {
      ++line_;
      const std::size_t first = line.find_first_not_of(" \t\r");
      if (first != std::string::npos && line[first] != '#') return true;
    }
    return false;
  }
  [[noreturn]] void refuse(std::size_t column, const std::string& what) const {
    throw kit::Trouble(HDEV_E_ARG,
                       fmt::format("{}:{}:{}: {}", name_, std::max<std::size_t>(line_, 1), column, what));
  }

 private:
  std::string name_;
  std::ifstream file_;
  std::size_t line_ = 0;
};

constexpr std::size_t absent = static_cast<std::size_t>(-1);

/// Where the quantities stand in a line.
struct Columns {
  std::size_t n = 0;
  bool may_go_on = false;  // lines may have more fields than are named
  std::size_t t = absent;
  std::array<std::size_t, 3> p{absent, absent, absent};
  std::array<std::size_t, 4> q{absent, absent, absent, absent};
  std::size_t buttons = absent;
  double second = 1.0;  // one unit of the times
  double metre = 1.0;   // one unit of the positions
};

Columns read_heading(const TableFile& table, const std::string& line) {
  const auto fields = split(line);
  const auto place = [&](const std::string& name) {
    std::size_t found = absent;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (fields[i].text != name) continue;
      if (found != absent) table.refuse(fields[i].column, "a second column " + name + "; write it once");
      found = i;
    }
    return found;
  };
  Columns columns;
  columns.n = fields.size();
  const bool milliseconds = place("t_ms") != absent;
  columns.second = milliseconds ? 1e-3 : 1.0;
  columns.t = place(milliseconds ? "t_ms" : "t_s");
  if (columns.t == absent)
    table.refuse(1, "no column t_s; the first line names the columns: t_s,x_mm,y_mm,z_mm");
  const bool millimetres = place("x_mm") != absent;
  columns.metre = millimetres ? 1e-3 : 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string name = std::string(1, "xyz"[i]) + (millimetres ? "_mm" : "_m");
    columns.p[i] = place(name);
    if (columns.p[i] == absent)
      table.refuse(1, "no column " + name + "; write x_mm,y_mm,z_mm or x_m,y_m,z_m");
  }
  const std::array<const char*, 4> parts{"qw", "qx", "qy", "qz"};
  for (std::size_t i = 0; i < 4; ++i) columns.q[i] = place(parts[i]);
  for (std::size_t i = 1; i < 4; ++i)
    if ((columns.q[i] == absent) != (columns.q[0] == absent))
      table.refuse(1, "an attitude needs all of qw,qx,qy,qz; write all four columns or none");
  columns.buttons = place("buttons");
  return columns;
}

Pose read_pose(const TableFile& table, const std::string& line, const Columns& columns) {
  const auto fields = split(line);
  if (fields.size() != columns.n && !(columns.may_go_on && fields.size() > columns.n))
    table.refuse(fields.back().column,
                 fmt::format("{} fields, {} {}; write one for each", fields.size(),
                             columns.may_go_on ? "wanted are" : "the first line names", columns.n));
  const auto number = [&](std::size_t i) {
    double value = 0;
    if (!kit::read_number(fields[i].text, value))
      table.refuse(fields[i].column, fmt::format("\"{}\" is no number; write one", fields[i].text));
    return value;
  };
  Pose pose;
  pose.t = number(columns.t) * columns.second;
  for (std::size_t i = 0; i < 3; ++i)
    pose.p[static_cast<Eigen::Index>(i)] = number(columns.p[i]) * columns.metre;
  if (columns.q[0] != absent) {
    pose.q = Eigen::Quaterniond(number(columns.q[0]), number(columns.q[1]), number(columns.q[2]),
                                number(columns.q[3]));
  }
  if (columns.buttons != absent) {
    const double buttons = number(columns.buttons);
    if (buttons < 0 || buttons > most_buttons || buttons != std::floor(buttons))
      table.refuse(fields[columns.buttons].column, "buttons is a sum of 1, 2, 4, ... up to 65535");
    pose.buttons = static_cast<std::uint32_t>(buttons);
  }
  return pose;
}

}  // namespace

PosePath read_pose_table(const std::string& file, const std::string& names) {
  TableFile table(file);
  std::string line = names;
  if (names.empty() && !table.next(line))
    table.refuse(1, "nothing in it; the first line names the columns: t_s,x_mm,y_mm,z_mm");
  Columns columns = read_heading(table, line);
  columns.may_go_on = !names.empty();
  PosePath path;
  path.has_attitude = columns.q[0] != absent;
  path.has_buttons = columns.buttons != absent;
  while (table.next(line)) {
    const Pose pose = read_pose(table, line, columns);
    const bool in_order = path.poses.empty() || pose.t > path.poses.back().t;
    if (const auto wrong = path.take(pose); !wrong.empty())
      table.refuse(split(line)[in_order && path.has_attitude ? columns.q[0] : columns.t].column, wrong);
  }
  if (path.poses.empty()) table.refuse(1, "no pose; write one a line below the names of the columns");
  return path;
}

}  // namespace palpate::haptic::replay
