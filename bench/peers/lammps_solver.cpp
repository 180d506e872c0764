// LAMMPS, as a child process: one rank, or two under mpirun.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

#include "bench/peers/lammps_files.h"
#include "bench/peers/solver.h"
#include "common/file/scratch_folder.h"
#include "deploy/palpate/child.h"
#include "deploy/palpate/install_paths.h"

namespace palpate::bench {
namespace {

namespace fs = std::filesystem;

class LammpsSolver final : public Solver {
 public:
  LammpsSolver(fs::path lmp, fs::path mpirun, int ranks) : lmp_(std::move(lmp)), mpirun_(std::move(mpirun)) {
    method_ = {"LAMMPS", "velocity Verlet", "double", ranks, Scheme::leapfrog, 70, {}, 1 << 30};
    if (ranks == 1) method_.drop_steps = {2, 3, 4, 6, 8, 12, 16};
  }
  const Method& method() const override { return method_; }

  Run run(const Task& task) override {
    const ScratchFolder scratch;
    const fs::path folder = scratch.path();
    std::string script = lammps_script(task);
    script.replace(script.find("body.data"), 9, (folder / "body.data").string());
    if (task.positions) script.replace(script.find("end.dump"), 8, (folder / "end.dump").string());
    write_lammps_data(folder / "body.data", task.drop->body);
    std::ofstream(folder / "in.lammps") << script;
    const bool clean = deploy::Child(method_.threads > 1 ? mpirun_ : lmp_, arguments(folder)).wait().clean();
    const LammpsLog log = read_lammps_log(folder / "log.lammps");
    Run run{clean && log.finished, {}, log.cpu_s, log.wall_s};
    if (run.sound && task.positions) {
      run.displacement = read_lammps_dump(folder / "end.dump", task.drop->body);
      run.sound = !run.displacement.empty();
    }
    return run;
  }

 private:
  std::vector<std::string> arguments(const fs::path& folder) const {
    std::vector<std::string> words;
    if (method_.threads > 1) {
      // Ranks of one machine talk through memory; nothing leaves it.
      words = {"-np",
               std::to_string(method_.threads),
               "--oversubscribe",
               "--mca",
               "btl",
               "self,vader",
               "--mca",
               "oob_tcp_if_include",
               "lo"};
      if (geteuid() == 0) words.push_back("--allow-run-as-root");
      words.push_back(lmp_.string());
    }
    for (const std::string& word : {std::string("-in"), (folder / "in.lammps").string(), std::string("-log"),
                                    (folder / "log.lammps").string(), std::string("-screen"),
                                    std::string("none"), std::string("-nocite")})
      words.push_back(word);
    return words;
  }

  fs::path lmp_, mpirun_;
  Method method_;
};

/// A run without a single atom says who it is.
std::string version_of(const fs::path& lmp) {
  const ScratchFolder scratch;
  const fs::path in = scratch.path() / "in.lammps", log = scratch.path() / "log.lammps";
  std::ofstream(in) << "units si\n";
  deploy::Child(lmp, {"-in", in.string(), "-log", log.string(), "-screen", "none", "-nocite"}).wait();
  return read_lammps_log(log).version;
}

}  // namespace

Peer lammps_peer() {
  Peer peer{
      "LAMMPS",
      "",
      "lammps",
      "Same springs, same scheme, same steps; double precision only (Debian's build has no single or mixed "
      "one, and no threads or vectors for bonds), and general: it stores every bond, we store none.",
      {}};
  const fs::path lmp = deploy::program_on_path("lmp");
  if (lmp.empty()) return peer;
  peer.version = version_of(lmp);
  peer.solvers.push_back(std::make_unique<LammpsSolver>(lmp, fs::path(), 1));
  const fs::path mpirun = deploy::program_on_path("mpirun");
  if (!mpirun.empty()) peer.solvers.push_back(std::make_unique<LammpsSolver>(lmp, mpirun, 2));
  return peer;
}

}  // namespace palpate::bench
