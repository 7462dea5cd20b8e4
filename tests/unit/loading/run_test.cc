#include "floc/loading/run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "floc/neighbors/find_contacts.h"
#include "support/dynamics.h"

namespace floc {
namespace {

/// A run that holds its first pressure and takes the adhesion away.
RunOptions losing_adhesion() {
  RunOptions options;
  options.law = test::cohesive_law();
  options.assembly.pressure = 0.5;
  LoadTurn hold;
  hold.name = "hold";
  hold.to = 0.5;
  hold.set = {{"adhesion.force", 0.0}};
  options.load = {hold};
  options.relaxation.strain_rate_cap = 0.05;
  return options;
}

TEST(Run, StepsThatChangeTheLawStartFromTheForcesOfTheNewOne) {
  RunPoint point;
  point.step = 1;
  Packing<2> packing = test::gas_of(30, test::cohesive_law(), 0.6);
  packing.cell.matrix *= 0.85;
  for (Vec<2>& x : packing.grains.position) x *= 0.85;
  find_contacts(packing);
  const auto n_distant = [](const Packing<2>& of) {
    return std::count_if(of.contacts.begin(), of.contacts.end(), [](const auto& c) { return c.distant; });
  };
  const auto n_touching = packing.contacts.size() - n_distant(packing);
  ASSERT_GT(n_touching, 10u);
  const floc::Run<2> run(losing_adhesion(), point, packing);
  EXPECT_EQ(run.packing().contacts.size(), n_touching);
  for (const Contact<2>& c : run.packing().contacts) EXPECT_EQ(c.normal_force, c.elastic_force);
}

/// Root mean square of the speeds that a run from a saved packing of disks up to a = m = 1 begins with.
double starting_speed(const LawParameters& law, double agitation, double pressure) {
  RunOptions options;
  options.law = law;
  options.assembly.protocol = AssemblyOptions::Protocol::state;
  options.assembly.agitation = agitation;
  options.assembly.pressure = pressure;
  options.assembly.saved.read = [] { return test::agitated_gas(30, test::cohesive_law()); };
  options.relaxation.strain_rate_cap = 0.05;
  const floc::Run<2> run(options);
  double squares = 0.0;
  for (const Vec<2>& v : run.packing().grains.velocity) squares += v.squaredNorm();
  return std::sqrt(squares / run.packing().grains.size());
}

TEST(Run, AgitatesASavedPackingByItsAdhesionOrElseByItsLoad) {
  LawParameters law = test::cohesive_law();
  EXPECT_EQ(starting_speed(law, 0.0, 0.5), 0.0);
  EXPECT_NEAR(starting_speed(law, 0.3, 0.5), 0.3 * std::sqrt(1.0 * 1e-3), 1e-14);  // sqrt(F0 D0/m)
  law.adhesion->range = 0.0;
  EXPECT_NEAR(starting_speed(law, 0.3, 0.5), 0.3 * std::sqrt(0.5), 1e-14);  // sqrt(P a^2/m)
  law.adhesion.reset();
  EXPECT_NEAR(starting_speed(law, 0.3, 0.5), 0.3 * std::sqrt(0.5), 1e-14);
}

TEST(Run, AtItsEndIsFinishedAndNeedsNoTarget) {
  RunPoint point;
  point.step = 2;
  const floc::Run<2> run(losing_adhesion(), point, test::gas_of(30, test::cohesive_law(), 0.3));
  EXPECT_TRUE(run.finished());
}

}  // namespace
}  // namespace floc
