#include "physics_node/step/energy_account.h"

#include <algorithm>
#include <cmath>

namespace palpate::physics {

Energies sum_energies(const BodyModels& bodies, const Vec3& gravity) {
  Energies sum;
  for (const auto& body : bodies) {
    const Energies e = body->energies(gravity);
    sum.kinetic += e.kinetic;
    sum.between += e.between;
    sum.elastic += e.elastic;
    sum.gravitational += e.gravitational;
  }
  return sum;
}

Losses sum_losses(const BodyModels& bodies) {
  Losses sum;
  for (const auto& body : bodies) sum += body->losses();
  return sum;
}

Losses sum_losses_and_due(const BodyModels& bodies) {
  Losses sum = sum_losses(bodies);
  for (const auto& body : bodies) sum += body->due();
  return sum;
}

void EnergyAccount::restart(const Energies& now, const Losses& lost, const StepReport& report) {
  start_ = now;
  lost_ = lost;
  booked_ = Booked(report);
  most_fallen_ = guard_ = 0;
}

void EnergyAccount::save(bool good, const StepReport& report) noexcept { saved_.next(good) = Booked(report); }

void EnergyAccount::restore(StepReport& report) noexcept {
  report.contact_lost = saved_.good().contact_lost;
  report.cut = saved_.good().cut;
  report.cut_by_released = saved_.good().cut_by_released;
  report.tool_exchange = saved_.good().tool_exchange;
  save(false, report);
}

void EnergyAccount::note(double fallen) noexcept {
  most_fallen_ = std::max(most_fallen_, std::abs(fallen + start_.gravitational));
}

EnergyLedger EnergyAccount::book(const Energies& now, const Losses& lost,
                                 const Booked& booked) const noexcept {
  EnergyLedger ledger;
  ledger.kinetic = now.between;
  ledger.elastic = now.elastic;
  ledger.gravitational = now.gravitational;
  ledger.dissipated = lost.viscous - lost_.viscous;
  ledger.plastic = lost.plastic - lost_.plastic;
  ledger.numerical = lost.numerical - lost_.numerical;
  ledger.broken = lost.broken - lost_.broken - (booked.cut_by_released - booked_.cut_by_released);
  ledger.tool_work = booked.tool_work - booked_.tool_work;
  ledger.contact = booked.contact_lost - booked_.contact_lost;
  ledger.cut = booked.cut - booked_.cut;
  ledger.guard = guard_;
  ledger.start = start_.between + start_.elastic + start_.gravitational;
  ledger.exchanged = start_.kinetic + start_.elastic + (booked.tool_exchange - booked_.tool_exchange) +
                     std::max(most_fallen_, std::abs(now.gravitational - start_.gravitational));
  return ledger;
}

double EnergyAccount::put_in(double fallen, const StepReport& report) const noexcept {
  return start_.kinetic + start_.elastic + (report.tool_exchange - booked_.tool_exchange) +
         std::max(most_fallen_, std::abs(fallen + start_.gravitational));
}

}  // namespace palpate::physics
