#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "bench/haptic/proxy_oracle.h"
#include "bench/haptic/rows.h"
#include "bench/haptic/rows_surface.h"
#include "bench/haptic/rows_touch.h"
#include "bench/haptic/rubbish.h"
#include "common/scene/device_spec.h"
#include "haptic_node/device/calibration.h"

namespace palpate::bench {
namespace {

std::size_t count(const Runs& runs, std::size_t full, std::size_t quick) {
  return runs.effort == Effort::full ? full : quick;
}

}  // namespace

Row proxy_is_exact(const Runs& runs) {
  const ProxyErrors errors = compare_with_oracle(count(runs, 100'000, 10'000), 7);
  return {"S9", "proxy of 1 to 8 random planes against an enumeration in long double",
          "error <= 1e-9 m, Karush-Kuhn-Tucker conditions kept, infeasible sets flagged",
          fmt::format("{} sets ({} infeasible): error {:.1g} m, conditions broken {}, missed {}", errors.sets,
                      errors.infeasible, errors.distance, errors.conditions_broken, errors.missed),
          errors.distance <= 1e-9 && errors.conditions_broken == 0 && errors.missed == 0};
}

/// Relative errors of x -> device -> world, of F_d . v_d = (f_s / s) F_w . v_w.
Row calibration_is_exact(const Runs& runs) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> g;
  std::uniform_real_distribution<double> decade(-1, 1);
  double worst = 0;
  const std::size_t n = count(runs, 10'000, 1'000);
  for (std::size_t i = 0; i < n; ++i) {
    DeviceSpec spec;
    spec.rotation =
        Eigen::Quaterniond(g(random), g(random), g(random), g(random)).normalized().toRotationMatrix();
    spec.scale = std::pow(10.0, decade(random));
    spec.force_scale = std::pow(10.0, decade(random));
    spec.offset = {g(random), g(random), g(random)};
    const haptic::Calibration calibration(spec);
    const Vec3 x(g(random), g(random), g(random)), f(g(random), g(random), g(random)),
        v(g(random), g(random), g(random));
    const double size = x.norm() + spec.offset.norm() + f.norm() * v.norm() * spec.force_scale / spec.scale;
    const auto note = [&](double error, double by) { worst = std::max(worst, error / by); };
    note((calibration.world_from_device(calibration.device_from_world(x)) - x).norm(), size);
    note((calibration.force_to_world(calibration.force_to_device(f)) - f).norm(), f.norm());
    const Vec3 v_d = spec.rotation.transpose() * v / spec.scale;
    note(std::abs(calibration.force_to_device(f).dot(v_d) - spec.force_scale / spec.scale * f.dot(v)), size);
  }
  return {"S13", "random rotations, scales 0.1 to 10, offsets: there and back, and power", "<= 1e-12",
          fmt::format("{} calibrations: {:.1g}", n, worst), worst <= 1e-12};
}

Row rubbish_is_harmless(const Runs& runs) {
  const std::size_t n = count(runs, 1'000'000, 50'000);
  std::string figure;
  bool pass = true;
  for (const auto model : {ForceModel::norton, ForceModel::tangent}) {
    const RubbishResult r = feed_rubbish(n, model, 1);
    figure += fmt::format(
        "{}{} {}: {} rejected, {} taken, {} of them wrongly; {} bad forces; most {:.3f} of {:.1f} N",
        figure.empty() ? "" : "; ", r.fed, model == ForceModel::norton ? "patches" : "wrenches", r.rejected,
        r.taken, r.wrongly_taken, r.bad_forces, r.force_most, r.limit);
    pass = pass && r.bad_forces == 0 && r.wrongly_taken == 0 && r.rejected > n / 10 && r.taken > n / 100;
  }
  return {
      "F3",
      "patches and wrenches of NaN, Inf, 1e30, bad normals, stiffness, counts, tools, old and future ticks "
      "and stamps, one a tick in contact",
      "force finite and within the limit in every tick; bad ones rejected whole, none of another tool or "
      "older than the last taken",
      figure, pass};
}

std::vector<Row> all_rows(Runs& runs) {
  return {direct_and_raw_are_unstable(runs),
          wall_is_stable(runs),
          stiffest_wall(runs),
          matrix_is_stable(runs),
          push_without_a_hand_gains_nothing(runs),
          stiff_matrix_is_stable(runs),
          force_is_true(runs),
          pulse_is_felt(runs),
          force_steps_are_small(runs),
          teleports_push_gently(),
          edges_and_corners(),
          sphere_is_round(),
          proxy_is_exact(runs),
          free_space_is_free(),
          saturation_is_quiet(),
          calibration_is_exact(runs),
          unruly_links_are_borne(runs),
          gaps_are_borne(runs),
          clocks_may_differ(runs),
          silence_fades(),
          return_is_no_kick(),
          rubbish_is_harmless(runs),
          bad_devices_are_stopped(),
          world_raw_is_unstable(runs),
          world_is_stable(runs),
          world_wall_is_stable(runs),
          world_bears_a_stiff_spring(runs),
          world_force_is_true(runs),
          world_tissue_is_stable(runs),
          world_tissue_is_true(runs),
          world_tissue_slides(runs),
          world_tissue_swings(runs),
          world_tissue_taps(runs),
          world_tissue_relaxes(runs),
          world_tissue_bears_a_stick(runs),
          world_pulse_is_felt(runs),
          world_teleports_push_gently(),
          world_edge_has_no_ghost(runs),
          world_free_space_is_free(),
          world_saturation_is_quiet(),
          world_bears_unruly_links(runs),
          world_silence_fades(),
          world_return_is_no_kick(),
          torque_is_bounded(runs),
          stick_is_steady(runs),
          stick_with_torques_is_steady(runs),
          sines_are_felt_as_borne(runs),
          lump_of_a_chain_is_seen_through(runs),
          sines_on_elements_are_felt_as_borne(runs),
          one_mode_of_elements_is_seen_through(runs),
          taps_on_elements_are_felt_as_borne(runs),
          taps_are_felt_as_borne(runs),
          relaxation_is_felt(runs),
          clear_tip_bears_nothing(runs),
          cuts_are_felt(runs),
          copy_is_stable(runs),
          copy_gains_nothing_without_a_hand(runs),
          copy_bears_wrong_models(runs),
          copy_bears_a_wrong_first_touch(runs),
          copy_keeps_energy_with_any_model(runs),
          extrapolated_force_is_unstable(runs),
          pulse_is_felt_by_copy(runs),
          surface_taps_are_felt_as_borne(runs),
          slides_are_felt_as_borne(runs),
          frozen_surface_is_seen_through(runs),
          modes_alone_are_seen_through(runs),
          hold_after_a_slide_is_still(runs),
          surface_gives_nothing_to_a_handle(runs)};
}

}  // namespace palpate::bench
