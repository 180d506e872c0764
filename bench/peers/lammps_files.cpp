#include "bench/peers/lammps_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <stdexcept>

namespace palpate::bench {
namespace {

// Room for the swing of the free faces; the faces of the box are open.
constexpr double room = 0.5;

std::string heading(const SpringBody& body) {
  Vec3 low = body.rest.front(), high = low;
  for (const Vec3& x : body.rest) low = low.cwiseMin(x), high = high.cwiseMax(x);
  low.array() -= room, high.array() += room;
  return fmt::format(
      "palpate bench peers\n\n{} atoms\n{} bonds\n2 atom types\n1 bond types\n20 extra bond per atom\n\n"
      "{:.17g} {:.17g} xlo xhi\n{:.17g} {:.17g} ylo yhi\n{:.17g} {:.17g} zlo zhi\n\n"
      "Masses\n\n1 {:.17g}\n2 {:.17g}\n\nAtoms\n\n",
      body.rest.size(), body.springs.size(), low.x(), high.x(), low.y(), high.y(), low.z(), high.z(),
      body.mass, body.mass);
}

}  // namespace

void write_lammps_data(const std::filesystem::path& file, const SpringBody& body) {
  std::ofstream out(file);
  out << heading(body);
  for (std::size_t i = 0; i < body.rest.size(); ++i) {
    const Vec3& x = body.rest[i];
    out << fmt::format("{} 1 {} {:.17g} {:.17g} {:.17g}\n", i + 1, body.held[i] != 0 ? 2 : 1, x.x(), x.y(),
                       x.z());
  }
  out << "\nBonds\n\n";
  for (std::size_t n = 0; n < body.springs.size(); ++n)
    out << fmt::format("{} 1 {} {}\n", n + 1, body.springs[n].i + 1, body.springs[n].j + 1);
  if (!out.flush()) throw std::runtime_error(fmt::format("{}: cannot be written", file.string()));
}

std::string lammps_script(const Task& task) {
  const SpringBody& body = task.drop->body;
  const Spring& spring = body.springs.front();
  const double g = body.gravity.norm();
  const Vec3 down = body.gravity / g;
  // E = K (r - r0)^2, so K = k / 2. Atoms stay in our order, which follows the rows and was faster than its sorting.
  std::string script = fmt::format(
      "units si\natom_style bond\nboundary f f f\natom_modify sort 0 0\npair_style none\nbond_style "
      "harmonic\n"
      "special_bonds lj 1 1 1\ncomm_modify cutoff {:.17g}\nread_data body.data\nbond_coeff 1 {:.17g} "
      "{:.17g}\n"
      "neigh_modify every 1000000 delay 1000000 check no\ngroup mobile type 1\nfix 1 mobile nve\n"
      "fix 2 mobile gravity {:.17g} vector {:.17g} {:.17g} {:.17g}\ntimestep {:.17g}\nthermo 100000000\nrun "
      "{}\n",
      2.5 * spring.length, 0.5 * spring.k, spring.length, g, down.x(), down.y(), down.z(), task.dt(),
      task.steps());
  if (task.positions) script += "write_dump all custom end.dump id x y z modify sort id format float %.17g\n";
  return script;
}

LammpsLog read_lammps_log(const std::filesystem::path& file) {
  static const std::regex loop("^Loop time of ([0-9.e+-]+) on ([0-9]+) procs");
  static const std::regex use("^([0-9.]+)% CPU use");
  LammpsLog log;
  double ranks = 1;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (log.version.empty() && line.rfind("LAMMPS (", 0) == 0) {
      log.version = line.substr(8, line.rfind(')') - 8);
    } else if (std::regex_search(line, match, loop)) {
      log.wall_s = std::stod(match[1]), ranks = std::stod(match[2]);
    } else if (std::regex_search(line, match, use)) {
      log.cpu_s = log.wall_s * ranks * std::stod(match[1]) / 100;
      log.finished = true;
    }
  }
  return log;
}

std::vector<Vec3> read_lammps_dump(const std::filesystem::path& file, const SpringBody& body) {
  std::vector<Vec3> displacement;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line) && line.rfind("ITEM: ATOMS", 0) != 0;) {
  }
  std::size_t id = 0;
  double x = 0, y = 0, z = 0;
  while (displacement.size() < body.rest.size() && in >> id >> x >> y >> z && id == displacement.size() + 1)
    displacement.push_back(Vec3(x, y, z) - body.rest[id - 1]);
  if (displacement.size() < body.rest.size()) displacement.clear();
  return displacement;
}

}  // namespace palpate::bench
