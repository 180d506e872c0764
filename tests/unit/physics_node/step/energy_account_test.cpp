// The ledger of energy: what must add up, and what its error is measured by.

#include "physics_node/step/energy_account.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "physics_node/step/rebound.h"

namespace palpate::physics {
namespace {

/// 10 J at the start and 5 J of tool work; every other place has its share.
EnergyLedger balanced_ledger() {
  EnergyLedger ledger;
  ledger.start = 10;
  ledger.tool_work = 5;
  ledger.kinetic = 1;
  ledger.elastic = 2;
  ledger.gravitational = -1;
  ledger.dissipated = 4;
  ledger.plastic = 3;
  ledger.numerical = -0.5;
  ledger.broken = 2.5;
  ledger.contact = 2.75;
  ledger.cut = 0.25;
  ledger.guard = 1;
  ledger.exchanged = 20;
  return ledger;
}

TEST(EnergyLedger, MissesNothingWhereAllIsBooked) {
  EXPECT_DOUBLE_EQ(balanced_ledger().missing(), 0);
  EXPECT_DOUBLE_EQ(balanced_ledger().balance_error(), 0);
}

/// Whatever is lost and not booked is missing by itself; so is what appears.
TEST(EnergyLedger, MissesEachPlaceByWhatItLacks) {
  for (double EnergyLedger::*place :
       {&EnergyLedger::kinetic, &EnergyLedger::elastic, &EnergyLedger::gravitational,
        &EnergyLedger::dissipated, &EnergyLedger::plastic, &EnergyLedger::numerical, &EnergyLedger::broken,
        &EnergyLedger::contact, &EnergyLedger::cut, &EnergyLedger::guard}) {
    EnergyLedger ledger = balanced_ledger();
    ledger.*place -= 0.25;
    EXPECT_DOUBLE_EQ(ledger.missing(), 0.25);
    EXPECT_DOUBLE_EQ(ledger.balance_error(), 0.25 / 20);
    ledger.*place += 0.5;
    EXPECT_DOUBLE_EQ(ledger.missing(), -0.25);
    EXPECT_DOUBLE_EQ(ledger.balance_error(), 0.25 / 20);
  }
}

TEST(EnergyLedger, MeasuresByAPicojouleWhereAlmostNothingWasExchanged) {
  EnergyLedger ledger;
  ledger.start = 1e-12;
  EXPECT_DOUBLE_EQ(ledger.balance_error(), 1);
}

/// What tools and contact did before a restart is not part of the new ledger.
TEST(EnergyAccount, BooksFromItsRestartOn) {
  StepReport report;
  report.tool_work = 7;
  report.tool_exchange = 9;
  report.contact_lost = 2;
  report.cut = 0.5;
  EnergyAccount account;
  account.restart({}, {}, report);
  report.tool_work += 3;
  report.tool_exchange += 4;
  report.contact_lost += 1;
  report.cut += 0.125;
  Energies now;
  now.between = 0.5;
  now.elastic = 0.25;
  Losses lost;
  lost.viscous = 1;
  lost.broken = 0.125;
  const EnergyLedger ledger = account.book(now, lost, Booked(report));
  EXPECT_DOUBLE_EQ(ledger.tool_work, 3);
  EXPECT_DOUBLE_EQ(ledger.contact, 1);
  EXPECT_DOUBLE_EQ(ledger.cut, 0.125);
  EXPECT_DOUBLE_EQ(ledger.exchanged, 4);
  EXPECT_DOUBLE_EQ(ledger.missing(), 0) << "3 in; 0.75 there, 2.25 lost";
  EXPECT_DOUBLE_EQ(account.put_in(0, report), 4);
}

/// Tissue that falls 2 J and swings back up has exchanged 2 J, though nothing of it shows now.
TEST(EnergyAccount, RemembersTheMostThatGravityDid) {
  EnergyAccount account;
  account.restart({}, {}, StepReport());
  account.note(2);
  account.note(0.5);
  EXPECT_DOUBLE_EQ(account.book({}, {}, {}).exchanged, 2);
}

TEST(EnergyAccount, WritesOffWhatAGuardTook) {
  EnergyAccount account;
  account.restart({}, {}, StepReport());
  StepReport report;
  report.tool_work = 3;
  const EnergyLedger before = account.book({}, {}, Booked(report));
  EXPECT_DOUBLE_EQ(before.missing(), 3);
  account.write_off(before);
  EXPECT_DOUBLE_EQ(account.book({}, {}, Booked(report)).missing(), 0);
  EXPECT_DOUBLE_EQ(account.book({}, {}, Booked(report)).guard, 3);
}

/// Of the two states that are saved the older one is good, until the younger has proved itself.
TEST(EnergyAccount, BringsBackWhatContactAndCutsTookAndToolsExchanged) {
  EnergyAccount account;
  StepReport report;
  const auto at = [&](double amount) {
    report.contact_lost = report.tool_exchange = report.tool_work = report.cut = amount;
    return &report;
  };
  account.save(false, *at(1));
  account.save(true, *at(2));  // what was saved at 1 is good
  account.restore(*at(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(report.contact_lost, 1);
  EXPECT_EQ(report.cut, 1);
  EXPECT_EQ(report.tool_exchange, 1);
  EXPECT_TRUE(std::isnan(report.tool_work)) << "work stays booked, and is written off";
  account.save(true, *at(3));  // the younger is now what was brought back
  account.restore(*at(4));
  EXPECT_EQ(report.contact_lost, 1);
  account.save(false, *at(5));
  account.save(true, *at(6));
  account.restore(*at(7));
  EXPECT_EQ(report.contact_lost, 5);
}

/// An impact of v_n < 0 ends with -e v_n; what rests is held, whatever e; nothing bounces higher than an elastic impact.
TEST(Rebound, IsThatOfItsRestitution) {
  for (const double e : {0.0, 0.3, 1.0}) {
    EXPECT_DOUBLE_EQ(-2.0 + rebound(e, -2.0, -2.0), 2.0 * e) << "an impact";
    EXPECT_DOUBLE_EQ(-0.02 + rebound(e, -0.01, -0.02), 0.0)
        << "at rest, pressed on: all of the step's approach goes back";
    EXPECT_LE(rebound(e, -0.01, -5.0), 0.02) << "never more than an elastic impact";
  }
}

}  // namespace
}  // namespace palpate::physics
