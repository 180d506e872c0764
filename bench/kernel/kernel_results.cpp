#include "bench/kernel/kernel_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/machine/limits.h"
#include "bench/problems/settings.h"

namespace palpate::bench {
namespace {

const char* lattice_name(LatticeKind lattice) { return lattice == LatticeKind::fcc ? "fcc" : "voxel"; }

/// What memory and arithmetic allow: triad over as many bytes as the state holds, and multiplications with additions, fused
/// and not.
nlohmann::json limits(const std::vector<KernelRow>& rows) {
  nlohmann::json json;
  for (const bool single : {true, false})
    for (const auto& row : rows)
      if ((row.kind.precision == Precision::single_) == single) {
        json["multiply_add_Gflop_per_s"][single ? "single" : "double"] =
            1e-9 * multiply_add_flops_per_s(single);
        json["fma_Gflop_per_s"][single ? "single" : "double"] = 1e-9 * fma_flops_per_s(single);
        break;
      }
  std::map<std::pair<int, int>, double> measured;  // by powers of two of bytes, and threads
  for (const auto& row : rows) {
    const double bytes = row.work.bytes * static_cast<double>(row.masses);
    const std::pair key(static_cast<int>(std::lround(std::log2(bytes))), row.threads);
    if (measured.count(key) == 0)
      measured[key] = triad_bytes_per_s(static_cast<std::size_t>(1) << key.first, key.second);
  }
  for (const auto& [key, rate] : measured)
    json["triad"].push_back(
        {{"bytes", std::pow(2.0, key.first)}, {"threads", key.second}, {"GB_per_s", 1e-9 * rate}});
  return json;
}

}  // namespace

double KernelRow::median_ns() const {
  std::vector<double> sorted = ns;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t n = sorted.size();
  return n == 0 ? 0 : 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]);
}

double KernelRow::least_ns() const { return ns.empty() ? 0 : *std::min_element(ns.begin(), ns.end()); }

double KernelRow::real_time_factor() const {
  const double frame = 1e-3;
  const double steps = std::ceil(frame / (0.8 * stable_step) - 1e-9);
  return frame / (steps * 1e-9 * median_ns() * static_cast<double>(masses));
}

std::string line_of(const KernelRow& row) {
  const double ns = row.median_ns();
  return fmt::format(
      "{:5} {:6} {:8} {} threads {:9} masses {:8.2f} ns/mass {:8.1f} M/s {:7.1f} GB/s {:7.1f} GFLOP/s",
      lattice_name(row.kind.lattice), name_of(row.kind.precision), name_of(row.kind.work), row.threads,
      row.masses, ns, 1e3 / ns, row.work.bytes / ns, row.work.flops / ns);
}

bool write_kernel_results(const ResultFolder& folder, const std::vector<KernelRow>& rows) {
  Table table{{"lattice", "precision", "work", "threads", "masses", "elements", "ns_per_mass",
               "ns_per_mass_least", "Mmass_steps_per_s", "bytes_per_mass", "GB_per_s", "flops_per_mass",
               "Gflop_per_s", "stable_step_s", "real_time_factor_1kHz"},
              {}};
  for (const auto& row : rows) {
    const double ns = row.median_ns();
    table.add({lattice_name(row.kind.lattice), name_of(row.kind.precision), name_of(row.kind.work),
               std::to_string(row.threads), std::to_string(row.masses), std::to_string(row.elements),
               text_of(ns), text_of(row.least_ns()), text_of(1e3 / ns), text_of(row.work.bytes),
               text_of(row.work.bytes / ns), text_of(row.work.flops), text_of(row.work.flops / ns),
               text_of(row.stable_step), text_of(row.real_time_factor())});
  }
  folder.write_csv(table);
  nlohmann::json results = {{"limits", limits(rows)}};
  for (const auto& line : table.rows) {
    nlohmann::json json;
    for (std::size_t column = 0; column < line.size(); ++column) {
      if (column < 3)
        json[table.heading[column]] = line[column];
      else
        json[table.heading[column]] = std::stod(line[column]);
    }
    results["rows"].push_back(std::move(json));
  }
  folder.write_json(results);
  return folder.plot();
}

}  // namespace palpate::bench
