#pragma once
// What a hand feels, what tissue bears, and what both should be, for one motion of the hand that no force can change.
//
// The reference is the ideal coupling: the force that the true motion gives through the same spring and damper without any
// delay. The bare tissue it cannot be: with K in series a hand feels K / (K + Z) of it at best. All are of the same sample of the
// hand, not of the same moment: tissue cannot bear what it has not been told.

#include <array>
#include <complex>
#include <functional>
#include <string>
#include <vector>

#include "bench/haptic/trial.h"

namespace palpate::bench {

/// How old what the hand knows of tissue is at most, from a sample to its answer.
struct LinkAge {
  const char* name;
  double age;      // [s]
  double rate_Hz;  // of frames
  double delay;    // each way [s]
  double loss;     // each way
};
inline constexpr std::array<LinkAge, 3> link_ages{
    {{"2 ms", 2e-3, 1000, 0, 0}, {"20 ms", 20e-3, 150, 6e-3, 0}, {"100 ms", 0.1, 20, 25e-3, 0.1}}};

/// No friction, no steps of an encoder: the motion is what is told.
Case led_case(const SpecimenModel& specimen, const LinkAge& age);
/// The same with the coupling that `palpate run` has, whose tissue is a lump and lives in its own time.
Case todays_case(const ObjectModel& object, const LinkAge& age);

/// One sample of the hand; depths and forces into the tissue.
struct Touched {
  double t = 0;        // [s]
  double x = 0;        // true depth [m]
  double felt = 0;     // command, before the hold is paid [N]
  double command = 0;  // that goes to the motor, and acts 1.5 ms later in the mean [N]
  double borne = 0;    // by the tissue [N]
  double ideal = 0;    // [N]
};

struct TouchRun {
  std::vector<Touched>
      samples;             // from t = 0 on; those at the end that the tissue had not come to are left out
  double surplus = 0;      // G [J]
  double made = 0;         // energy that steps of the copy have made by themselves [J]
  double step_beyond = 0;  // of force in a tick, beyond K v T [N]
};

/// A led hand on `c.specimen`, which today's coupling takes as `c.object`.
TouchRun lead_hand(const Case& c, const Path& path, double until);

/// 0 before t = 0, 1 after `time`, without a jump of speed.
double haversine(double t, double time) noexcept;
/// A place at t [m], as a path.
Path path_of(std::function<Vec3(double t)> place);
/// Depth at t [m], as a path straight down.
Path straight_down(std::function<double(double t)> depth);

/// 0.5 mm about 2 mm; the last whole cycles, a second of them at least.
struct SineResult {
  std::complex<double> felt_by_borne, borne_by_ideal, felt_by_ideal, motor_by_borne;
  double surplus = 0, made = 0;
};
SineResult feel_sine(const Case& c, double frequency_Hz);

/// One of T1's.
struct SineFelt {
  std::string specimen, age;
  double frequency_Hz = 0;
  SineResult result;
};

/// 2 mm deep and out again as a haversine of `time`, from `clear` above.
TouchRun tap(const Case& c, double time, double clear);
double peak_of(const TouchRun& run, double Touched::*force);
/// [N s]
double impulse_of(const TouchRun& run, double Touched::*force);

/// Down by 2 mm in 20 ms and held for 2.9 s. @return rms of felt less ideal over that of ideal
double relaxation_error(const Case& c);

/// 1 N pressed by a hand on a Touch; after 2 s the tissue keeps a fifth of its stiffness.
struct CutResult {
  double caught_up = 0;  // after the cut, when felt stays within 0.05 N of borne [s]
  double rise = 0;       // of felt above what it was before [N]
  double surplus = 0, step_beyond = 0;
};
CutResult cut_under_hand(const LinkAge& age);

}  // namespace palpate::bench
