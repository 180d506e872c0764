#pragma once
// Strokes of a scalpel, and what must hold after each: no matter lost, no momentum made, the surface closed, the books even.

#include <cstdint>
#include <string>
#include <vector>

#include "bench/cuts/random_cuts.h"

namespace palpate::bench {

struct CutResult {
  std::string kind;
  std::uint64_t seed = 0;
  int strokes = 0;
  double gives_way = 0;  // toughness / modulus, in cells
  double area = 0;       // that is booked as cut [m^2]
  std::int64_t opened = 0, copies = 0, masses = 0, steps = 0;
  double mass_off = 0, momentum_off = 0, angular_off = 0;  // as shares; momenta: of what has been exchanged
  double balance_error = 0;                                // of the ledger
  double cut_off = 0;                                      // |energy.cut - toughness x area|, as a share
  double least_J = 1;                                      // of corners of cells or of tetrahedra
  std::int64_t open_edges = 0;                             // of the surface, as it is drawn
  std::int64_t restored = 0;                               // times that the guard acted
  bool finite = true;
  std::int64_t other_from =
      -1;  // the first frame after which, done again after a reset, its bits differ; -1: none
  bool undoes =
      true;  // undone at its end, and done again and undone as soon as it cuts, the last stroke leaves the same bits
  double cpu_s = 0;
};

/// What a result may be off by, in double.
inline constexpr double most_mass_off = 1e-13, most_momentum_off = 1e-11, most_cut_off = 1e-6,
                        most_balance_error = 1e-2;

CutResult run_cuts(CutKind kind, std::uint64_t seed, const std::string& folder);
/// What of it does not hold, in words; EMPTY: all holds.
std::string faults(const CutResult& result);

const std::vector<std::string>& cut_heading();
std::vector<std::string> words(const CutResult& result);

}  // namespace palpate::bench
