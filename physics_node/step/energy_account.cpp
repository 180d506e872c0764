#include "physics_node/step/energy_account.h"

#include <cmath>

namespace palpate::physics {

Energies sum_energies(const MovingBodies& bodies, const Vec3& gravity) {
  Energies sum;
  for (const auto& body : bodies) {
    const Energies e = body->energies(gravity);
    sum.kinetic += e.kinetic;
    sum.elastic += e.elastic;
    sum.gravitational += e.gravitational;
  }
  return sum;
}

Losses sum_losses(const MovingBodies& bodies) {
  Losses sum;
  for (const auto& body : bodies) {
    const Losses lost = body->losses();
    sum.viscous += lost.viscous;
    sum.plastic += lost.plastic;
    sum.numerical += lost.numerical;
    sum.broken += lost.broken;
    sum.breaks += lost.breaks;
  }
  return sum;
}

void EnergyAccount::restart(const MovingBodies& bodies, const Vec3& gravity, const StepReport& report) {
  start_ = sum_energies(bodies, gravity);
  lost_ = sum_losses(bodies);
  work_ = report.tool_work;
  exchange_ = report.tool_exchange;
  contact_ = report.contact_lost;
  guard_ = 0;
}

EnergyLedger EnergyAccount::book(const Energies& now, const Losses& lost,
                                 const StepReport& report) const noexcept {
  EnergyLedger ledger;
  ledger.kinetic = now.kinetic;
  ledger.elastic = now.elastic;
  ledger.gravitational = now.gravitational;
  ledger.dissipated = lost.viscous - lost_.viscous;
  ledger.plastic = lost.plastic - lost_.plastic;
  ledger.numerical = lost.numerical - lost_.numerical;
  ledger.broken = lost.broken - lost_.broken;
  ledger.tool_work = report.tool_work - work_;
  ledger.contact = report.contact_lost - contact_;
  ledger.guard = guard_;
  ledger.start = start_.kinetic + start_.elastic + start_.gravitational;
  ledger.exchanged = start_.kinetic + start_.elastic + (report.tool_exchange - exchange_) +
                     std::abs(now.gravitational - start_.gravitational);
  return ledger;
}

double EnergyAccount::put_in(double fallen, const StepReport& report) const noexcept {
  return start_.kinetic + start_.elastic + (report.tool_exchange - exchange_) +
         std::abs(fallen + start_.gravitational);
}

}  // namespace palpate::physics
