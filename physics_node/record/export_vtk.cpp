#include "physics_node/record/export_vtk.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <regex>

#include "common/error/error.h"
#include "common/record/hdf5_file.h"
#include "common/scene/body_spec.h"
#include "common/scene/material_spec.h"
#include "common/scene/render_spec.h"
#include "common/scene/scene.h"
#include "common/scene/tool_spec.h"
#include "physics_node/appearance/colours.h"
#include "physics_node/boundary/surface.h"
#include "physics_node/record/vtp_file.h"

namespace palpate::physics {
namespace {

namespace fs = std::filesystem;
constexpr std::uint64_t most_rows = 1 << 24;  // snapshots of a body. Why: a day at 190 a second

/// One body of the record: its series, and the mesh that they give.
class ExportedBody {
 public:
  ExportedBody(const Hdf5File& file, const Scene& scene, std::size_t b)
      : file_(file),
        base_("/bodies/" + scene.bodies[b].name),
        rgba_(body_colour(scene, b)),
        threshold_(scene.render->threshold),
        moving_(make_body_model(build_body(scene.bodies[b], scene.materials), Precision::single_)),
        live_(*moving_),
        number_(static_cast<std::size_t>(body().capacity())) {
    if (file.shape(base_ + "/rest").at(0) != body().nodes().size())
      throw InputError(fmt::format("{}: the record and the scene do not have the same masses", base_));
    std::uint32_t next = 0;
    for (const Index cell : body().nodes()) number_[static_cast<std::size_t>(cell)] = next++;
    follows_breaks_ = file.has(base_ + "/live");
    look();
  }

  const std::string& name() const { return body().name; }
  std::vector<double> times() const { return file_.read<double>(base_ + "/time", most_rows); }

  /// The mesh of one recorded time.
  VtpMesh mesh(std::uint64_t row) {
    if (follows_breaks_) follow(row);
    const auto position = file_.read_rows<float>(base_ + "/position", row, 1, 3 * body().nodes().size());
    std::vector<std::uint32_t> vertices;
    VtpMesh mesh = facets(true, vertices);
    VtpArray displacement{"displacement", 3, {}};
    for (const std::uint32_t v : vertices) {
      const Vec3 place = moves(v) ? place_of(v, position) : surface_.rest[v];
      for (int a = 0; a < 3; ++a) {
        const auto rest = static_cast<float>(surface_.rest[v][a]), now = static_cast<float>(place[a]);
        mesh.points.push_back(now);
        displacement.values.push_back(now - rest);
      }
    }
    mesh.on_points.push_back(std::move(displacement));
    if (follows_breaks_) mesh.on_points.push_back(yielded_share(row, vertices));
    return mesh;
  }

  /// What does not move. No polygons: there is none.
  VtpMesh scenery() const {
    std::vector<std::uint32_t> vertices;
    VtpMesh mesh = facets(false, vertices);
    for (const std::uint32_t v : vertices)
      for (int a = 0; a < 3; ++a) mesh.points.push_back(static_cast<float>(surface_.rest[v][a]));
    return mesh;
  }

 private:
  const Body& body() const { return moving_->body(); }
  void look() { surface_ = make_surface(body(), live_, threshold_, rgba_); }

  void follow(std::uint64_t row) {
    auto recorded = file_.read_rows<Mask>(base_ + "/live", row, 1, body().nodes().size());
    if (recorded == recorded_) return;
    recorded_ = std::move(recorded);
    live_.copy(body(), recorded_);
    look();
  }

  bool moves(std::uint32_t vertex) const { return vertex < surface_.n_moving(); }
  std::size_t number_of(std::uint32_t vertex) const {
    return number_[static_cast<std::size_t>(surface_.cell[vertex])];
  }
  /// @param position  of each mass, as recorded
  Vec3 place_of(std::uint32_t vertex, const std::vector<float>& position) const {
    const auto at = [&](Index node) {
      const float* p = &position[3 * number_[static_cast<std::size_t>(node)]];
      return Vec3(p[0], p[1], p[2]);
    };
    if (surface_.bearers.empty()) return at(surface_.cell[vertex]);
    return surface_.rest[vertex] + surface_.bearers[vertex].mean([&](Index node) {
      return Vec3(at(node) - body().rest_position(node));
    });
  }

  VtpArray yielded_share(std::uint64_t row, const std::vector<std::uint32_t>& vertices) const {
    const auto shares = file_.read_rows<std::uint8_t>(base_ + "/yielded", row, 1, body().nodes().size());
    VtpArray array{"yielded_share", 1, {}};
    for (const std::uint32_t v : vertices)
      array.values.push_back(moves(v) ? static_cast<float>(shares[number_of(v)]) / 255.0F : 0.0F);
    return array;
  }

  /// The facets that have a moving corner, or those that have none. @param vertices  out: of the surface, those they use
  VtpMesh facets(bool moving, std::vector<std::uint32_t>& vertices) const {
    VtpMesh mesh;
    std::vector<std::int32_t> point(surface_.n_vertices(), -1);
    for (std::size_t f = 0; f < surface_.facets.size(); ++f) {
      const auto& facet = surface_.facets[f];
      if (std::any_of(facet.begin(), facet.end(), [&](std::uint32_t corner) { return moves(corner); }) !=
          moving)
        continue;
      const std::size_t corners = facet[3] == facet[2] ? 3 : 4;
      for (std::size_t c = 0; c < corners; ++c) {
        if (point[facet[c]] < 0) {
          point[facet[c]] = static_cast<std::int32_t>(vertices.size());
          vertices.push_back(facet[c]);
        }
        mesh.corners.push_back(point[facet[c]]);
      }
      mesh.ends.push_back(static_cast<std::int32_t>(mesh.corners.size()));
      for (int byte = 0; byte < 3;
           ++byte)  // not how opaque: the facets are, and a viewer would show what is behind them
        mesh.rgb.push_back(static_cast<std::uint8_t>(surface_.rgba[f] >> (8 * byte) & 0xff));
    }
    return mesh;
  }

  const Hdf5File& file_;
  std::string base_;
  std::uint32_t rgba_;
  std::optional<double> threshold_;
  std::unique_ptr<BodyModel> moving_;
  LiveElements live_;
  std::vector<std::uint32_t> number_;  // of the mass in a storage cell, as the record counts
  std::vector<Mask> recorded_;         // live elements of each node
  Surface surface_;
  bool follows_breaks_ = false;
};

/// The rows of t_p_force_moment of one tool, by time.
class ExportedTool {
 public:
  ExportedTool(const Hdf5File& file, const std::string& name)
      : file_(file),
        path_("/tools/" + name + "/t_p_force_moment"),
        n_(file.has(path_) ? file.shape(path_).at(0) : 0) {}

  /// The last row not after t; nothing where there is none.
  std::optional<std::vector<double>> at(double t) const {
    std::uint64_t first = 0, last = n_;  // rows before `first` are not after t, those from `last` on are
    while (first < last) {
      const std::uint64_t middle = first + (last - first) / 2;
      (file_.read_rows<double>(path_, middle, 1, width).at(0) <= t + 1e-9 ? first = middle + 1
                                                                          : last = middle);
    }
    if (first == 0) return std::nullopt;
    return file_.read_rows<double>(path_, first - 1, 1, width);
  }

 private:
  static constexpr std::uint64_t width = 10;
  const Hdf5File& file_;
  std::string path_;
  std::uint64_t n_;
};

VtpMesh tools_at(const std::vector<ExportedTool>& tools, double t) {
  VtpMesh mesh;
  VtpArray force{"force", 3, {}}, moment{"moment", 3, {}}, number{"tool", 1, {}};
  for (std::size_t n = 0; n < tools.size(); ++n) {
    const auto row = tools[n].at(t);
    if (!row) continue;
    for (std::size_t a = 0; a < 3; ++a) {
      mesh.points.push_back(static_cast<float>((*row)[1 + a]));
      force.values.push_back(static_cast<float>((*row)[4 + a]));
      moment.values.push_back(static_cast<float>((*row)[7 + a]));
    }
    number.values.push_back(static_cast<float>(n));
  }
  mesh.on_points = {std::move(force), std::move(moment), std::move(number)};
  return mesh;
}

/// Rows at which `rate_Hz` a second are due.
std::vector<std::uint64_t> rows_due(const std::vector<double>& times, double rate_Hz) {
  std::vector<std::uint64_t> rows;
  double next = times.empty() ? 0 : times.front();
  for (std::size_t n = 0; n < times.size(); ++n) {
    if (times[n] + 1e-9 < next) continue;
    rows.push_back(n);
    next = std::max(next + 1 / rate_Hz, times[n]);
  }
  return rows;
}

/// Is it one of the files of an earlier export? A person's own in that folder stay.
bool is_ours(const fs::path& path) {
  static const std::regex form("(body_.+_[0-9]{5,}|scenery_.+|tools_[0-9]{5,})\\.vtp");
  return std::regex_match(path.filename().string(), form);
}

/// The parts of an export, and the file that ties them together.
class Series {
 public:
  Series(fs::path folder, fs::perms rights) : folder_(std::move(folder)), rights_(rights) {
    fs::create_directories(folder_ / "vtk");
    fs::permissions(folder_ / "vtk", with_search(rights_));
    for (const auto& entry : fs::directory_iterator(folder_ / "vtk"))
      if (is_ours(entry.path())) fs::remove(entry.path());
  }

  /// A part of one time. @param file  without ending
  void add(const std::string& file, int part, double t, VtpMesh mesh) {
    mesh.t = t;
    const std::string name = "vtk/" + file + ".vtp";
    bytes_ += write_vtp((folder_ / name).string(), mesh);
    fs::permissions(folder_ / name, rights_);
    parts_.push_back({t, part, name});
  }
  /// The same file again.
  void repeat(const std::string& file, int part, double t) {
    parts_.push_back({t, part, "vtk/" + file + ".vtp"});
  }

  fs::path close() {
    const fs::path path = folder_ / "record.pvd";
    write_pvd(path.string(), parts_);
    fs::permissions(path, rights_);
    return path;
  }
  std::uint64_t bytes() const { return bytes_; }

 private:
  /// Who may read the files may look into their folder.
  static fs::perms with_search(fs::perms rights) {
    using enum fs::perms;
    fs::perms folder = (rights & (owner_all | group_all | others_all)) | owner_all;
    if ((rights & group_read) != none) folder |= group_exec;
    if ((rights & others_read) != none) folder |= others_exec;
    return folder;
  }

  fs::path folder_;
  fs::perms rights_;
  std::vector<PvdPart> parts_;
  std::uint64_t bytes_ = 0;
};

}  // namespace

VtkExport export_vtk(const std::string& record, const Scene& scene, const VtkWish& wish) {
  const Hdf5File file(record, Hdf5File::Mode::read);
  VtkExport done;
  if (scene.bodies.empty() || !file.has("/bodies/" + scene.bodies.front().name + "/position")) return done;
  std::vector<ExportedBody> bodies;
  bodies.reserve(scene.bodies.size());
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) bodies.emplace_back(file, scene, b);
  std::vector<ExportedTool> tools;
  for (const ToolSpec& tool : scene.tools) tools.emplace_back(file, tool.name);

  std::vector<double> times = bodies.front().times();
  for (const auto& body : bodies)
    times.resize(std::min(times.size(), body.times().size()));  // a record cut short
  std::vector<std::uint64_t> rows = rows_due(times, wish.rate_Hz);
  if (rows.empty()) return done;
  Series series(wish.folder, fs::status(record).permissions());
  const auto scenery_file = [&](std::size_t b) { return "scenery_" + bodies[b].name(); };
  std::vector<bool> has_scenery;
  for (const auto& body : bodies) {
    VtpMesh scenery = body.scenery();
    has_scenery.push_back(!scenery.ends.empty());
    const auto part = static_cast<int>(bodies.size() + has_scenery.size());
    if (has_scenery.back())
      series.add(scenery_file(has_scenery.size() - 1), part, times[rows.front()], std::move(scenery));
  }
  const std::uint64_t fixed_bytes = series.bytes();
  std::size_t stride = 1;
  double last_t = 0;
  for (std::size_t n = 0; n < rows.size(); n += stride) {
    const double t = times[rows[n]];
    last_t = t;
    ++done.times;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      series.add(fmt::format("body_{}_{:05}", bodies[b].name(), done.times), static_cast<int>(b), t,
                 bodies[b].mesh(rows[n]));
      const auto part = static_cast<int>(bodies.size() + b + 1);
      if (has_scenery[b] && n > 0) series.repeat(scenery_file(b), part, t);
    }
    VtpMesh tips = tools_at(tools, t);
    if (tips.n_points() > 0)
      series.add(fmt::format("tools_{:05}", done.times), static_cast<int>(bodies.size()), t, std::move(tips));
    if (n > 0) continue;
    const std::uint64_t each = std::max<std::uint64_t>(series.bytes() - fixed_bytes, 1);
    const std::uint64_t room = wish.most_bytes > fixed_bytes ? (wish.most_bytes - fixed_bytes) / each : 1;
    const std::size_t most = std::max<std::uint64_t>(room, 1);
    stride = (rows.size() + most - 1) / most;
  }
  done.thinned = stride > 1;
  done.every_s = done.times > 1 ? (last_t - times[rows.front()]) / static_cast<double>(done.times - 1) : 0;
  done.bytes = series.bytes();
  done.collection = series.close();
  return done;
}

}  // namespace palpate::physics
