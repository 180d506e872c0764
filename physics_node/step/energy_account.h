#pragma once
// Keeps the books of energy from a start on: what was there, what has come in, what was lost.

#include <memory>
#include <vector>

#include "physics_node/step/body_model.h"
#include "physics_node/step/energy_ledger.h"
#include "physics_node/step/good_state.h"
#include "physics_node/step/step_report.h"

namespace palpate::physics {

Energies sum_energies(const BodyModels& bodies, const Vec3& gravity);
Losses sum_losses(const BodyModels& bodies);
/// The same with what the next step will book at once: see Books::due().
Losses sum_losses_and_due(const BodyModels& bodies);

/// What tools and contact have done, as the report has counted it.
struct Booked {
  double tool_work = 0, tool_exchange = 0, contact_lost = 0, cut = 0, cut_by_released = 0;  // [J]
  explicit Booked(const StepReport& report)
      : tool_work(report.tool_work),
        tool_exchange(report.tool_exchange),
        contact_lost(report.contact_lost),
        cut(report.cut),
        cut_by_released(report.cut_by_released) {}
  Booked() = default;
};

class EnergyAccount {
 public:
  /// What is there now is what the ledger starts from.
  /// @param lost  by then, with what is due
  void restart(const Energies& now, const Losses& lost, const StepReport& report);

  /// The ledger of a moment, from energies and losses then and what tools and contact had done by then.
  EnergyLedger book(const Energies& now, const Losses& lost, const Booked& booked) const noexcept;

  /// Remembers the most that gravity has done so far; of a state that stays. @param fallen  sum of m g . u
  void note(double fallen) noexcept;

  /// All that was ever put in: what there was at the start, the magnitude of the tools' work, and the most that gravity has given: what
  /// swings back to its start has taken all of it back, and holds only what its steps err by. [J] @param fallen  sum of m g . u
  double put_in(double fallen, const StepReport& report) const noexcept;

  /// What contact and cuts took and by how much tools exchanged energy is part of the state that the guard brings
  /// back, as the losses of elements are. What tools did stays booked: work on a state that is thrown away,
  /// which write_off() takes out.
  /// @param good  the state saved before this one is what restore() goes back to from now on
  void save(bool good, const StepReport& report) noexcept;
  void restore(StepReport& report) noexcept;

  /// Counts what is missing from this ledger as taken out by the guard.
  void write_off(const EnergyLedger& ledger) noexcept { guard_ += ledger.missing(); }

 private:
  Energies start_;
  Losses lost_;             // at the start
  Booked booked_;           // at the start
  double most_fallen_ = 0;  // magnitude, since the start [J]
  double guard_ = 0;        // [J]
  GoodState<Booked> saved_;
};

}  // namespace palpate::physics
