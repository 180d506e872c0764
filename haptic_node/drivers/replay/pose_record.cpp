#include "haptic_node/drivers/replay/pose_record.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <fstream>
#include <set>

#include "common/record/dataset_list.h"
#include "common/record/hdf5_file.h"
#include "haptic_node/drivers/kit/driver.h"

namespace palpate::haptic::replay {
namespace {

constexpr const char* run_dataset = "t_p_force_moment";
constexpr const char* wanted = "t_s and p_m, or one of /tools in the record of a run";

using Shape = std::vector<std::uint64_t>;

class Group {
 public:
  Group(const std::string& file, const std::string& path)
      : file_(file), path_(path.empty() ? only_group() : path), hdf5_(file, Hdf5File::Mode::read) {
    if (path_.back() != '/') path_ += '/';
  }

  bool has(const std::string& name) const { return hdf5_.has(path_ + name); }

  /// All numbers of a dataset of `width` columns (1: a list). @param n  rows that there must be; 0: any number
  std::vector<double> read(const std::string& name, std::uint64_t width, std::uint64_t n = 0) const {
    if (!has(name)) refuse(fmt::format("no dataset {}{}; wanted is a group with {}", path_, name, wanted));
    const Shape shape = hdf5_.shape(path_ + name);
    const bool right = shape.size() == (width == 1 ? 1u : 2u) && (width == 1 || shape[1] == width);
    if (!right || shape[0] == 0 || shape[0] > most_poses || (n > 0 && shape[0] != n))
      refuse(fmt::format("{}{} is {} numbers; {} x {} are wanted", path_, name, fmt::join(shape, " x "),
                         n > 0 ? std::to_string(n) : "n", width));
    return hdf5_.read<double>(path_ + name);
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw kit::Trouble(HDEV_E_ARG, file_ + ": " + what);
  }
  const std::string& path() const { return path_; }

 private:
  std::string only_group() const {
    std::set<std::string> groups;
    for (const auto& dataset : list_datasets(file_)) {
      if (dataset.path == "/t_s") return "/";
      const auto slash = dataset.path.rfind('/');
      if (dataset.path.substr(slash + 1) == run_dataset) groups.insert(dataset.path.substr(0, slash));
    }
    if (groups.empty()) refuse(fmt::format("no movement in it; wanted is a group with {}", wanted));
    if (groups.size() > 1)
      refuse(fmt::format("there are several movements; choose with group = {}", fmt::join(groups, " or ")));
    return *groups.begin();
  }

  std::string file_, path_;
  Hdf5File hdf5_;
};

void take(PosePath& path, const Group& group, const Pose& pose) {
  if (const auto wrong = path.take(pose); !wrong.empty())
    group.refuse(fmt::format("row {} of {}: {}", path.poses.size(), group.path(), wrong));
}

PosePath read_run(const Group& group) {
  constexpr std::size_t width = 10;
  const auto rows = group.read(run_dataset, width);
  PosePath path;
  for (std::size_t i = 0; i < rows.size(); i += width) {
    Pose pose;
    pose.t = rows[i];
    pose.p = {rows[i + 1], rows[i + 2], rows[i + 3]};
    take(path, group, pose);
  }
  return path;
}

PosePath read_columns(const Group& group) {
  const auto t = group.read("t_s", 1);
  const auto p = group.read("p_m", 3, t.size());
  PosePath path;
  path.has_attitude = group.has("q_wxyz");
  path.has_buttons = group.has("buttons");
  const auto q = path.has_attitude ? group.read("q_wxyz", 4, t.size()) : std::vector<double>();
  const auto buttons = path.has_buttons ? group.read("buttons", 1, t.size()) : std::vector<double>();
  for (std::size_t i = 0; i < t.size(); ++i) {
    Pose pose;
    pose.t = t[i];
    pose.p = {p[3 * i], p[3 * i + 1], p[3 * i + 2]};
    if (path.has_attitude) pose.q = Eigen::Quaterniond(q[4 * i], q[4 * i + 1], q[4 * i + 2], q[4 * i + 3]);
    if (path.has_buttons) {
      const double b = buttons[i];
      if (!(b >= 0 && b <= most_buttons && b == std::floor(b)))
        group.refuse(fmt::format("row {} of {}: buttons is a sum of 1, 2, 4, ... up to {}", i, group.path(),
                                 most_buttons));
      pose.buttons = static_cast<std::uint32_t>(b);
    }
    take(path, group, pose);
  }
  return path;
}

}  // namespace

bool is_pose_record(const std::string& file) {
  constexpr std::array<char, 8> signature{'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};
  std::array<char, 8> begin{};
  std::ifstream stream(file, std::ios::binary);
  return stream.read(begin.data(), begin.size()) && begin == signature;
}

PosePath read_pose_record(const std::string& file, const std::string& path) try {
  const Group group(file, path);
  return group.has(run_dataset) ? read_run(group) : read_columns(group);
} catch (const kit::Trouble&) {
  throw;
} catch (const std::exception& error) {  // of HDF5; it names the file
  throw kit::Trouble(HDEV_E_ARG, error.what());
}

}  // namespace palpate::haptic::replay
