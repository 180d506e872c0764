#include "bench/solids/calculix.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "common/file/scratch_folder.h"
#include "deploy/palpate/child.h"
#include "deploy/palpate/install_paths.h"

namespace palpate::bench {
namespace {

using Place = std::array<int, 3>;  // in half bricks, along x, y, z

/// Corners anticlockwise below and above, then the middles of their edges below, above, upright: the order of C3D20.
constexpr std::array<Place, 20> quadratic_nodes{{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2},
                                                 {2, 0, 2}, {2, 2, 2}, {0, 2, 2}, {1, 0, 0}, {2, 1, 0},
                                                 {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2}, {1, 2, 2},
                                                 {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}}};

/// The mesh as the deck numbers it, from 1 on.
struct Mesh {
  explicit Mesh(const BrickBlock& block) : n(block.bricks), half{2 * n[0], 2 * n[1], 2 * n[2]} {
    const std::size_t n_nodes = block.kind == Brick::quadratic ? 20 : 8;
    for (int k = 0; k < half[2]; k += 2)
      for (int j = 0; j < half[1]; j += 2)
        for (int i = 0; i < half[0]; i += 2) {
          auto& brick = bricks.emplace_back();
          for (std::size_t a = 0; a < n_nodes; ++a)
            brick.push_back(
                number({i + quadratic_nodes[a][0], j + quadratic_nodes[a][1], k + quadratic_nodes[a][2]}));
        }
  }
  int number(const Place& at) {
    const auto [found, fresh] = numbers.try_emplace(at, static_cast<int>(nodes.size()) + 1);
    if (fresh) nodes.push_back(at);
    return found->second;
  }
  Vec3 unit(const Place& at) const {
    return {1.0 * at[0] / half[0], 1.0 * at[1] / half[1], 1.0 * at[2] / half[2]};
  }

  std::array<int, 3> n, half;
  std::vector<Place> nodes;
  std::map<Place, int> numbers;
  std::vector<std::vector<int>> bricks;
};

/// What an even load on the end gives each of its nodes, in shares of the whole: a face of eight nodes gives its corners -1/12 and
/// its middles 1/3 each, one of four a quarter.
std::map<int, double> shares_of_end(Mesh& mesh, Brick kind) {
  std::map<int, double> shares;
  const double face = 1.0 / (mesh.n[1] * mesh.n[2]);
  for (int k = 0; k < mesh.half[2]; k += 2)
    for (int j = 0; j < mesh.half[1]; j += 2)
      for (int b = 0; b <= 2; ++b)
        for (int a = 0; a <= 2; ++a) {
          const int middles = (a == 1 ? 1 : 0) + (b == 1 ? 1 : 0);
          if (middles == 2 || (middles == 1 && kind != Brick::quadratic)) continue;
          const double share = kind != Brick::quadratic ? 0.25 : middles == 1 ? 1.0 / 3 : -1.0 / 12;
          shares[mesh.number({mesh.half[0], j + a, k + b})] += share * face;
        }
  return shares;
}

void write_deck(const std::filesystem::path& file, const BrickBlock& block, Mesh& mesh) {
  std::ofstream out(file);
  out << "*NODE,NSET=ALL\n";
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    const Vec3 x = block.place(mesh.unit(mesh.nodes[n]));
    out << fmt::format("{},{:.12g},{:.12g},{:.12g}\n", n + 1, x.x(), x.y(), x.z());
  }
  out << "*ELEMENT,TYPE=" << (block.kind == Brick::quadratic ? "C3D20R" : "C3D8I") << ",ELSET=E\n";
  for (std::size_t e = 0; e < mesh.bricks.size(); ++e) {
    out << e + 1;
    for (std::size_t a = 0; a < mesh.bricks[e].size(); ++a)
      out << "," << (a == 10 ? "\n" : "") << mesh.bricks[e][a];  // a line holds 16 entries
    out << "\n";
  }
  const auto list_nodes = [&](const char* name, int x) {
    out << "*NSET,NSET=" << name << "\n";
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
      if (mesh.nodes[n][0] == x) out << n + 1 << ",\n";
  };
  list_nodes("HELD", 0);
  list_nodes("END", mesh.half[0]);
  out << "*BOUNDARY\nHELD,1,3\n";
  if (block.flat) out << "ALL,2,2\n";
  out << fmt::format(
      "*MATERIAL,NAME=M\n*ELASTIC\n{:.12g},{:.12g}\n*DENSITY\n{:.12g}\n*SOLID SECTION,ELSET=E,MATERIAL=M\n"
      "*STEP\n*STATIC\n",
      block.modulus, block.poisson_ratio, block.density);
  if (block.gravity != 0) out << fmt::format("*DLOAD\nE,GRAV,{:.12g},0.,0.,-1.\n", block.gravity);
  if (block.lift != 0) {
    out << "*CLOAD\n";
    for (const auto& [node, share] : shares_of_end(mesh, block.kind))
      out << fmt::format("{},3,{:.12g}\n", node, share * block.lift);
  }
  out << "*NODE PRINT,NSET=END\nU\n*END STEP\n";
}

/// Lines of four numbers: a node and its displacement.
std::vector<std::pair<Vec3, Vec3>> read_end(const std::filesystem::path& file, const Mesh& mesh) {
  std::vector<std::pair<Vec3, Vec3>> end;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::size_t node = 0;
    Vec3 u;
    if (words >> node >> u.x() >> u.y() >> u.z() && node >= 1 && node <= mesh.nodes.size())
      end.emplace_back(mesh.unit(mesh.nodes[node - 1]), u);
  }
  return end;
}

double cpu_of_children() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

Vec3 BrickAnswer::mean() const {
  Vec3 sum = Vec3::Zero();
  for (const auto& [place, u] : end) sum += u;
  return sum / static_cast<double>(end.size());
}

Vec3 BrickAnswer::at(const Vec3& s) const {
  const auto found =
      std::ranges::find_if(end, [&](const auto& node) { return (node.first - s).norm() < 1e-9; });
  if (found == end.end()) throw std::runtime_error("no node of the bricks lies there");
  return found->second;
}

std::filesystem::path calculix() { return deploy::program_on_path("ccx"); }

BrickAnswer solve(const BrickBlock& block) {
  const std::filesystem::path program = calculix();
  if (program.empty()) throw std::runtime_error("CalculiX is not installed (apt-get install calculix-ccx)");
  const ScratchFolder scratch;
  Mesh mesh(block);
  write_deck(scratch.path() / "block.inp", block, mesh);
  const double before = cpu_of_children();
  // It leaves files where it stands, whatever its job is called; one thread, so that its time is that of the work.
  const bool clean =
      deploy::Child("/bin/sh", {"-c", "cd \"$0\" && OMP_NUM_THREADS=1 exec \"$1\" -i block > said",
                                scratch.path().string(), program.string()})
          .wait()
          .clean();
  BrickAnswer answer{read_end(scratch.path() / "block.dat", mesh), cpu_of_children() - before};
  if (!clean || answer.end.empty()) throw std::runtime_error("CalculiX gave no answer");
  return answer;
}

}  // namespace palpate::bench
