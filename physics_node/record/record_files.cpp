// The file side of the recorder: everything here but make_files() and finish() runs on its own thread.
#include <fmt/format.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>

#include "common/file/new_file.h"
#include "common/math/hash.h"
#include "common/report/commit.h"
#include "common/scene/scene.h"
#include "physics_node/record/recorder.h"

namespace palpate::physics {
namespace {

/// Facets whose four corners are masses, by mass number, for viewers.
std::vector<std::uint32_t> mass_facets(const BodyModel& moving, const Surface& surface) {
  std::vector<std::uint32_t> number(static_cast<std::size_t>(moving.body().capacity()), 0);
  std::uint32_t next = 0;
  for (const Index cell : moving.body().nodes()) number[static_cast<std::size_t>(cell)] = next++;
  std::vector<std::uint32_t> facets;
  facets.reserve(4 * surface.facets.size());
  for (const auto& facet : surface.facets) {
    bool all_move = true;
    for (const auto corner : facet) all_move = all_move && corner < surface.n_moving();
    if (!all_move) continue;
    for (const auto corner : facet) facets.push_back(number[static_cast<std::size_t>(surface.cell[corner])]);
  }
  return facets;
}

}  // namespace

std::FILE* Recorder::make_csv(const std::string& name, const char* heading) {
  const std::string path = folder_ + "/" + name;
  std::FILE* file = open_new(path);
  if (file == nullptr) throw std::runtime_error(path + ": " + std::strerror(errno));
  csv_.push_back(file);
  csv_names_.push_back(path);
  std::fprintf(file, "%s\n", heading);
  return file;
}

void Recorder::make_files(const World& world, const SceneSource& source) {
  for (const auto& name : tool_names_)
    make_csv(trace_name(name),
             "t_s,x_m,y_m,z_m,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,contacts,"
             "raw_fx_N,raw_fy_N,raw_fz_N,raw_mx_Nm,raw_my_Nm,raw_mz_Nm");
  if (spec_.energy)
    energy_csv_ =
        make_csv("energy.csv",
                 "t_s,kinetic_J,elastic_J,gravitational_J,dissipated_J,plastic_J,numerical_J,broken_J,"
                 "guard_J,tool_work_J,contact_J,cut_J");
  hdf5_ = std::make_unique<Hdf5File>(folder_ + "/record.h5", Hdf5File::Mode::record);
  hdf5_->set_text("palpate_record", "2");
  hdf5_->set_text("title", world.scene().title);
  hdf5_->set_text("commit", commit());
  hdf5_->set_text("scene_checksum", hex_of(world.scene().checksum));
  for (std::size_t b = 0; b < world.n_bodies(); ++b) {
    const BodyModel& moving = world.body(b);
    const std::string base = "/bodies/" + moving.body().name;
    const auto facets = mass_facets(moving, world.surface_as_loaded(b));
    std::vector<float> rest;
    rest.reserve(3 * static_cast<std::size_t>(moving.body().n_nodes()));
    for (const Index cell : moving.body().nodes())
      for (int a = 0; a < 3; ++a) rest.push_back(static_cast<float>(moving.body().rest_position(cell)[a]));
    body_names_.push_back(moving.body().name);
    hdf5_->write<float>(base + "/rest", {rest.size() / 3, 3}, rest.data());
    hdf5_->write<std::uint32_t>(base + "/facets", {facets.size() / 4, 4}, facets.data());
    if (!spec_.positions) continue;
    hdf5_->make_series<double>(base + "/time", {1});
    hdf5_->make_series<float>(base + "/position", {rest.size() / 3, 3});
    hdf5_->make_series<std::uint8_t>(base + "/flags", {rest.size() / 3});
    if (!may_change_for_good(moving.body())) continue;
    hdf5_->make_series<std::uint8_t>(base + "/yielded", {rest.size() / 3});
    hdf5_->make_series<std::uint32_t>(base + "/live", {rest.size() / 3});
  }
  for (const auto& name : tool_names_)
    hdf5_->make_series<double>("/tools/" + name + "/t_p_force_moment", {10});
  session_ = std::make_unique<SessionLog>(world, source, *hdf5_);
  hdf5_->start();
}

void Recorder::write_rows() {
  ToolRow row;
  while (rows_->pop(row)) {
    const auto& [p, f, m] = std::tie(row.p, row.force, row.moment);
    std::fprintf(csv_[row.tool], "%.6f,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%u", row.t, p[0], p[1],
                 p[2], f[0], f[1], f[2], m[0], m[1], m[2], row.contacts);
    for (const auto& raw : {row.raw_force, row.raw_moment})
      for (const double value : raw) std::fprintf(csv_[row.tool], ",%.9g", value);
    std::fprintf(csv_[row.tool], "\n");
    const std::array<double, 10> numbers{row.t, p[0], p[1], p[2], f[0], f[1], f[2], m[0], m[1], m[2]};
    hdf5_->append<double>("/tools/" + tool_names_[row.tool] + "/t_p_force_moment", numbers.data());
  }
}

void Recorder::write_energy() {
  EnergyRow row;
  while (energy_rows_->pop(row)) {
    const EnergyLedger& e = row.ledger;
    std::fprintf(energy_csv_, "%.6f,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", row.t,
                 e.kinetic, e.elastic, e.gravitational, e.dissipated, e.plastic, e.numerical, e.broken,
                 e.guard, e.tool_work, e.contact, e.cut);
  }
}

void Recorder::write_snapshots() {
  while (!snapshots_.empty() && snapshots_[next_written_]->full) {
    Snapshot& snapshot = *snapshots_[next_written_];
    for (std::size_t b = 0; b < body_names_.size(); ++b) {
      const std::string base = "/bodies/" + body_names_[b];
      hdf5_->append<double>(base + "/time", &snapshot.t);
      hdf5_->append<float>(base + "/position", snapshot.position[b].data());
      hdf5_->append<std::uint8_t>(base + "/flags", snapshot.flags[b].data());
      if (snapshot.live[b].empty()) continue;
      hdf5_->append<std::uint8_t>(base + "/yielded", snapshot.yielded[b].data());
      hdf5_->append<std::uint32_t>(base + "/live", snapshot.live[b].data());
    }
    snapshot.full = false;
    next_written_ = (next_written_ + 1) % n_snapshots;
  }
}

void Recorder::flush() {
  session_->flush();
  for (std::size_t n = 0; n < csv_.size(); ++n) {
    if (std::fflush(csv_[n]) != 0) throw std::runtime_error(csv_names_[n] + ": " + std::strerror(errno));
  }
}

void Recorder::work() noexcept {
  try {
    auto flushed = std::chrono::steady_clock::now();
    for (bool last = false; !last;) {
      last = stop_;
      session_->write();
      write_rows();
      write_energy();
      write_snapshots();
      const auto now = std::chrono::steady_clock::now();
      if (last || now - flushed > std::chrono::seconds(1)) {
        flush();
        flushed = now;
      }
      if (!last) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  } catch (const std::exception& error) {
    failure_ = error.what();
    failed_ = true;
  }
}

void Recorder::finish(const World& world) {
  if (finished_) return;
  finished_ = true;
  note_end(world);
  session_->end(world);
  stop_ = true;
  thread_.join();
  if (failed_) throw std::runtime_error(failure_);
  hdf5_->close();
}

}  // namespace palpate::physics
