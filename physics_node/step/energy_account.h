#pragma once
// Keeps the books of energy from a start on: what was there, what has come in, what was lost.

#include <memory>
#include <vector>

#include "physics_node/step/energy_ledger.h"
#include "physics_node/step/moving_body.h"
#include "physics_node/step/step_report.h"

namespace palpate::physics {

using MovingBodies = std::vector<std::unique_ptr<MovingBody>>;

Energies sum_energies(const MovingBodies& bodies, const Vec3& gravity);
Losses sum_losses(const MovingBodies& bodies);

class EnergyAccount {
 public:
  /// What is there now is what the ledger starts from.
  void restart(const MovingBodies& bodies, const Vec3& gravity, const StepReport& report);

  /// The ledger of this moment, from energies and losses now and the work of tools that the report has counted.
  EnergyLedger book(const Energies& now, const Losses& lost, const StepReport& report) const noexcept;

  /// All that was ever put in: what there was at the start, the magnitude of the tools' work, and what gravity has given
  /// since rest. [J] @param fallen  sum of m g . u
  double put_in(double fallen, const StepReport& report) const noexcept;

  /// Counts what is missing from this ledger as taken out by the guard.
  void write_off(const EnergyLedger& ledger) noexcept { guard_ += ledger.missing(); }

 private:
  Energies start_;
  Losses lost_;                     // at the start
  double work_ = 0, exchange_ = 0;  // of tools, at the start [J]
  double contact_ = 0;              // lost at the start [J]
  double guard_ = 0;                // [J]
};

}  // namespace palpate::physics
