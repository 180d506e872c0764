#pragma once
// Cases by the hundred: which are stable, which keep the bounds of energy.

#include <functional>
#include <string>
#include <vector>

#include "bench/haptic/trial.h"

namespace palpate::bench {

struct CaseResult {
  Case c;
  double swing = 0;                        // of the tip, peak to peak in the last second of the hold [m]
  double force = 0;                        // mean then [N]
  double surplus = 0;                      // largest G [J]
  double plane_excess = 0;                 // above the bound on the work of planes [J]
  double force_step = 0;                   // largest change in a tick [N]
  double step_beyond = 0;                  // the same less K v T [N]
  double force_least = 0, force_most = 0;  // then [N]
  double settled = 0;                      // after the end of the approach, within 5 % of `force` [s]
  double force_outside = 0;                // largest when the hand is 5 mm outside [N]
  double sideways = 0;                     // of the tip, the larger of x and y, then [m]
  double tissue_force = 0;                 // mean of what real tissue presses with then [N]
  int unready = 0;                         // ticks then in which the controller was not in run
  /// The hand felt what it pressed: a controller that never arms is still, quiet and passive as well.
  bool felt() const noexcept { return unready == 0 && force > 0.1; }
  bool energy_kept() const noexcept { return surplus <= EnergyBook::G_allowed && plane_excess <= 1e-9; }
};

/// Where the approach ends and the hold begins, and where it ends [s].
inline constexpr double approach_end = 0.3, hold_end = 4.0;

/// 6 s: press 1 N, hold, slide, retract. With no hand: 6 s of a constant push of 1 N.
/// @param move_object  moves the object, if given
CaseResult run_case(const Case& c, const std::function<void(Tissue&, double t)>& move_object = {});

struct MatrixSize {
  std::vector<double> rates_Hz{20, 60, 150, 1000};
  std::vector<double> delays{0, 5e-3, 20e-3, 50e-3};  // one way [s]
  std::vector<double> losses{0, 0.01, 0.1};
  std::vector<double> stiffnesses{300, 500};
};

/// Each of `bases` over every link.
std::vector<Case> over_links(const std::vector<Case>& bases, const MatrixSize& size);

/// Every hand but none, every object, for one device.
std::vector<Case> matrix(const DeviceModel& device, const MatrixSize& size, RenderMode mode);
/// The same for all devices.
std::vector<Case> all_devices(const MatrixSize& size, RenderMode mode = RenderMode::local);
/// Every object, for all devices, with no hand: the handle falls.
std::vector<Case> without_a_hand(const MatrixSize& size, RenderMode mode = RenderMode::local);

/// full: every case. quick: some of them, for tests.
enum class Effort { quick, full };

/// Every k-th case, so many that about `wanted` remain; all of them in a full run.
std::vector<Case> chosen(std::vector<Case> cases, Effort effort, std::size_t wanted);

/// In `jobs` threads; in the order of `cases`.
std::vector<CaseResult> run_cases(const std::vector<Case>& cases, int jobs,
                                  const std::function<void(std::size_t)>& done = {});

struct Tally {
  int cases = 0;
  // along or sideways, whichever is more
  int above_100_um = 0, above_200_um = 0, above_300_um = 0;
  int energy_broken = 0, unfelt = 0;
  double swing_most = 0, surplus_most = 0, plane_excess_most = 0, force_step_most = 0, step_beyond_most = 0;
  double force_error_most = 0;  // of the 1 N, where there is no friction
};
Tally tally(const std::vector<CaseResult>& results);

/// S2: none above 200 um, at most 1 % above 100 um, energy bounds and contact felt in all.
bool keeps_S2(const Tally& tally) noexcept;

/// Above 500 N/m two newton seconds per metre are needed.
inline double damping_for(double stiffness) noexcept { return stiffness > 500 ? 2.0 : 1.0; }

/// S1: `c` against a wall, as stiff as its device bears.
Case against_wall(Case c) noexcept;
/// S1: swings by no more than two steps of the encoder, or 100 um.
bool is_still(const CaseResult& result) noexcept;

/// "Touch arm O1 60 Hz 20 ms 10 % K 500 seed 7"
std::string text_of(const Case& c);

}  // namespace palpate::bench
