#include "deploy/import/memory_budget.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "common/error/error.h"

namespace palpate {
namespace {

constexpr double code = 0.1e9;      // of the limit: programs and libraries; 66 MB with ITK 5.2
constexpr double headers = 0.15e9;  // buffers of libraries, threads' stacks; measured: 40 MB
constexpr double shadow =
    1e12;                // data that no machine has: an address sanitizer's, under which nothing is held
double limit_bytes = 0;  // 0: none; set once, before anything is read

struct Use {
  double resident = 0, data = 0;  // [bytes]
};

/// Source: proc(5), /proc/pid/statm
Use in_use() {
  std::ifstream statm("/proc/self/statm");
  double size = 0, resident = 0, shared = 0, text = 0, unused = 0, data = 0;
  statm >> size >> resident >> shared >> text >> unused >> data;
  const auto page = static_cast<double>(sysconf(_SC_PAGESIZE));
  return {page * resident, page * data};
}

/// The kernel gives this process `more` bytes of data from here on, or what the limit leaves.
void allow(double more) noexcept {
  rlimit held{};
  if (limit_bytes == 0 || getrlimit(RLIMIT_DATA, &held) != 0) return;
  const double data = in_use().data;
  if (data > shadow) return;
  held.rlim_cur = static_cast<rlim_t>(std::min(data + more, std::max(limit_bytes - code, data)));
  held.rlim_cur = std::min(held.rlim_cur, held.rlim_max);
  setrlimit(RLIMIT_DATA, &held);
}

double gigabytes(double bytes) { return std::ceil(bytes * 1e-8) / 10; }

}  // namespace

void begin_memory(std::uint64_t limit, std::uint64_t file_bytes) noexcept {
  limit_bytes = static_cast<double>(limit);
  allow(headers + 2 * static_cast<double>(file_bytes));
}

void check_cost(const std::string& where, std::uint64_t cells, double bytes_a_cell) {
  const double cost = static_cast<double>(cells) * bytes_a_cell, whole = in_use().resident + cost + headers;
  if (limit_bytes == 0 || whole <= limit_bytes) return;
  throw InputError(fmt::format(
      "{}: {:.3g} million cells take some {:.1f} GB of memory, and {:.1f} GB are allowed; give a smaller "
      "image, or "
      "--memory-limit {:.1f} on a machine that has it",
      where, 1e-6 * static_cast<double>(cells), gigabytes(whole), 1e-9 * limit_bytes, gigabytes(whole)));
}

void declare_cells(const std::string& where, std::uint64_t cells, double bytes_a_cell) {
  check_cost(where, cells, bytes_a_cell);
  allow(static_cast<double>(cells) * bytes_a_cell + headers);
}

}  // namespace palpate
