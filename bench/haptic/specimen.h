#pragma once
// Tissue under a tip, in one dimension, as masses in a row: the tip presses the top one, the last link ends on a base.
//
//   m u_1'' = F - link(u_1 - u_2) - k_r (u_1 - p) - ...,   link: k d + c d', or a force that grows as d^1.5, or one that yields
//
// What it tells of itself is a TissueModel and the state of the real masses in it.

#include <memory>
#include <vector>

#include "bench/haptic/models.h"
#include "bench/haptic/solid_specimen.h"
#include "haptic_node/tissue/tissue_model.h"

namespace palpate::bench {

struct SpecimenModel {
  const char* name = "";
  int masses = 1;          // 0: a wall
  double mass = 0;         // of each [kg]
  double damping = 0;      // of each link [N s/m]
  double stiffness = 0;    // of each link [N/m]; with `hertz` k of k d^1.5 [N/m^1.5]
  double drag = 0;         // of each mass, to the base [N s/m]
  bool hertz = false;      // of a single mass
  double yield_force = 0;  // of a single mass: its link gives way beyond it; 0: never [N]
  double branch_stiffness = 0, branch_time = 1;  // at the top, to the base [N/m], [s]
  bool solid = false;                            // a block of finite elements instead of masses in a row
};

SpecimenModel specimen_of(const ObjectModel& object) noexcept;
/// Ten masses of 10 g: as soft as O1, lowest modes at 11, 32, 53 Hz.
extern const SpecimenModel chain_of_ten;
/// Standard linear solids: O1 with a branch of 200 N/m that relaxes in 0.1 s, and in 1 s.
extern const SpecimenModel relaxing_solid, slow_solid;
/// 300 N/m and 20 Hz at 2 mm.
extern const SpecimenModel hertz_ball;
/// The product's own elements, see SolidSpecimen.
extern const SpecimenModel solid_block;
/// O1 that yields at 0.5 N.
extern const SpecimenModel yielding_lump;

/// Factors on what is told of a single mass, for models that are wrong.
struct ModelError {
  double mass = 1, damping = 1, stiffness = 1;
  double learnt_in = 0;  // of contact, after which the stiffness is told right; 0: never [s]
  bool tells_branches = true;
  int modes = 3;
};

class Specimen {
 public:
  Specimen(const SpecimenModel& model, const ModelError& error);

  /// That it is stepped by [s].
  double step() const noexcept { return solid_ ? SolidSpecimen::step : 2e-5; }
  /// One step. @param force  on the top [N]
  void advance(double force, double dt);
  /// Moves the base [m], depth.
  void set_base(double base) noexcept { base_ = base; }
  /// A cut: links keep this share of their stiffness.
  void weaken(double share) noexcept { kept_ = share; }

  double surface() const noexcept { return solid_ ? solid_->surface() : u_.empty() ? base_ : u_[0]; }
  double speed() const noexcept { return solid_ ? solid_->speed() : v_.empty() ? 0.0 : v_[0]; }
  /// @param force  on the top now [N]
  void tell(double force, haptic::TissueAnswer& answer);

 private:
  double link_force(std::size_t i) noexcept;
  double tangent() const noexcept;
  void find_modes();
  double told_stiffness_factor() const noexcept;
  void tell_lump(double force, haptic::TissueAnswer& answer);
  void tell_modes(double force, haptic::TissueAnswer& answer);
  double smooth_rest(double rest) noexcept;

  SpecimenModel model_;
  ModelError error_;
  std::unique_ptr<SolidSpecimen> solid_;
  std::vector<double> u_, v_;  // from the top [m], [m/s]
  double base_ = 0, kept_ = 1;
  double plastic_ = 0;                       // [m]
  double branch_ = 0;                        // p [m]
  double pressed_for_ = 0;                   // [s]
  double acceleration_ = 0;                  // of the top [m/s^2]
  std::vector<std::vector<double>> shapes_;  // of the modes told, normalised by mass
  haptic::TissueModel modes_;                // without the cut
  bool rest_known_ = false;
  double rest_ = 0, since_told_ = 0;
};

}  // namespace palpate::bench
