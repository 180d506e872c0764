// The driver "replay": a handle that is led along a recorded path, whatever the force. The path begins when the forces
// are first switched on, and runs in the host's clock, real or simulated.

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "haptic_node/drivers/kit/driver.h"
#include "haptic_node/drivers/replay/pose_path.h"
#include "haptic_node/drivers/replay/pose_record.h"
#include "haptic_node/drivers/replay/pose_table.h"

namespace palpate::haptic {
namespace {

constexpr double closed_path = 1e-3;  // ends that lie closer count as one place [m]

struct Settings {
  replay::PosePath path;
  bool loop = false;
  double max_force = 0;
};

class ReplayDevice final : public kit::OpenDevice {
 public:
  ReplayDevice(const hdev_host& host, Settings settings)
      : OpenDevice(host), settings_(std::move(settings)), path_(settings_.path) {}

  void fill(hdev_info& info) const override {
    info.caps = measured() | HDEV_CAP_FORCE | HDEV_CAP_SIMULATED;
    std::snprintf(info.vendor, sizeof info.vendor, "palpate");
    std::snprintf(info.model, sizeof info.model, "recorded path of %.3g s", path_.duration());
    info.dof_in = path_.has_attitude ? 6 : 3;
    info.dof_out = 3;
    info.n_buttons = path_.has_buttons ? 16 : 0;
    for (Eigen::Index i = 0; i < 3; ++i) info.ws_min[i] = info.ws_max[i] = path_.poses.front().p[i];
    for (const auto& pose : path_.poses) {
      for (Eigen::Index i = 0; i < 3; ++i) {
        info.ws_min[i] = std::min(info.ws_min[i], pose.p[i]);
        info.ws_max[i] = std::max(info.ws_max[i], pose.p[i]);
      }
    }
    info.max_force = info.cont_force = settings_.max_force;
    info.nominal_rate_hz = 1000;
  }

  void power(bool on) override {
    if (on) asked_.store(true);
    powered_.store(on);
  }

  hdev_status read(hdev_state& state) noexcept override {
    const std::int64_t now = now_ns();
    if (!started_ && asked_.load()) {
      started_ = true;
      start_ns_ = now;
    }
    const double begin = path_.poses.front().t;
    double t = started_ ? begin + static_cast<double>(now - start_ns_) * 1e-9 : begin;
    if (settings_.loop) t = begin + std::fmod(t - begin, path_.duration());
    const replay::Pose pose = path_.at(t, hint_);
    state.valid = measured();
    state.seq = ++seq_;
    state.t_ns = now;
    const Eigen::Matrix3d r = pose.q.toRotationMatrix();
    for (Eigen::Index i = 0; i < 3; ++i) {
      state.pos[i] = pose.p[i];
      state.applied_force[i] = powered_.load() ? force_[i] : 0.0;
      for (Eigen::Index j = 0; j < 3; ++j) state.R[3 * i + j] = r(i, j);
    }
    state.buttons = pose.buttons;
    state.force_enabled = powered_.load() ? 1u : 0u;
    return HDEV_OK;
  }

  hdev_status write(const kit::Effort& effort) noexcept override {
    for (std::size_t i = 0; i < 3; ++i) force_[i] = effort.force[i];
    return HDEV_OK;
  }

  hdev_status stop() noexcept override {
    powered_.store(false);
    return HDEV_OK;
  }

 private:
  std::uint32_t measured() const noexcept {
    std::uint32_t what = HDEV_CAP_POS;
    if (path_.has_attitude) what |= HDEV_CAP_ROT;
    return what;
  }

  Settings settings_;
  const replay::PosePath& path_;
  std::size_t hint_ = 0;
  bool started_ = false;
  std::int64_t start_ns_ = 0;
  std::uint64_t seq_ = 0;
  double force_[3]{};
  std::atomic<bool> powered_{false};  // power() and stop() may come from other threads
  std::atomic<bool> asked_{false};
};

/// By what the file holds, not by its name; but a .traj names no columns.
replay::PosePath read_path(const std::string& file, std::string columns, const std::string& group) {
  if (file.empty()) throw kit::Trouble(HDEV_E_ARG, "no \"file\"; name a table of poses");
  const bool record = replay::is_pose_record(file);
  if (record && !columns.empty())
    throw kit::Trouble(HDEV_E_ARG, file + ": HDF5 has no \"columns\"; choose with \"group\"");
  if (!record && !group.empty())
    throw kit::Trouble(HDEV_E_ARG, file + ": a table has no \"group\"; leave it out, or name an HDF5 file");
  if (record) return replay::read_pose_record(file, group);
  if (columns.empty() && std::filesystem::path(file).extension() == ".traj") columns = replay::traj_columns;
  return replay::read_pose_table(file, columns);
}

std::vector<std::string> list() { return {"file"}; }

std::unique_ptr<kit::OpenDevice> open(const hdev_host& host, const std::string& id, kit::Options& options) {
  if (!id.empty() && id != "file")
    throw kit::Trouble(HDEV_E_NODEV, "no device \"" + id + "\"; there is only \"file\"");
  Settings settings;
  const std::string file = options.text("file", "");
  const std::string columns = options.text("columns", ""), group = options.text("group", "");
  settings.loop = options.yes("loop", false);
  settings.max_force = options.positive("max_force_N", 20.0);
  options.refuse_rest();
  settings.path = read_path(file, columns, group);
  const auto& poses = settings.path.poses;
  const double gap = (poses.back().p - poses.front().p).norm();
  if (settings.loop && (poses.size() < 2 || gap > closed_path))
    throw kit::Trouble(HDEV_E_ARG,
                       fmt::format("{}: the path ends {:.3g} mm from where it begins, which \"loop\" would "
                                   "jump over; lead it back, or set loop = false",
                                   file, 1e3 * gap));
  return std::make_unique<ReplayDevice>(host, std::move(settings));
}

}  // namespace

const kit::Driver& kit::this_driver() {
  static const Driver driver{"replay", "1.0", list, open};
  return driver;
}

}  // namespace palpate::haptic
