#include "floc/loading/run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "floc/elasticity/stability.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/packing/balance.h"
#include "support/contact_laws.h"
#include "support/dynamics.h"

namespace floc {
namespace {

/// Returns options of a run with one stage, which removes the adhesion at constant pressure.
RunOptions losing_adhesion() {
  RunOptions options;
  options.law = test::cohesive_law();
  options.assembly.pressure = 0.5;
  LoadStage hold;
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

void expect_measured(const State<2>& state) {
  EXPECT_EQ(state.stress, static_stress(state.packing));
  const Residuals r = residuals(state.packing, state.target_stress);
  EXPECT_EQ(state.residuals.force, r.force);
  EXPECT_EQ(state.residuals.moment, r.moment);
  EXPECT_EQ(state.residuals.stress, r.stress);
  EXPECT_EQ(state.residuals.energy, r.energy);
}

/// A state takes over quantities that the relaxer has measured. They must equal the quantities that are computed again
/// from the packing of the state.
TEST(Run, StatesCarryWhatWasMeasuredOfThem) {
  for (const bool equal_masses : {false, true})
    for (const Finish finish : {Finish::automatic, Finish::dynamic}) {
      RunOptions options = losing_adhesion();
      options.relaxation.equal_masses = equal_masses;
      options.grains.count = 30;
      options.grains.diameter.min = 0.5;
      options.grains.diameter.max = 1.0;
      options.assembly.solid_fraction = 0.6;
      options.load.front().set.clear();
      options.load.front().to = 0.6;
      options.load.front().steps = 1;
      options.relaxation.finish = finish;
      floc::Run<2> run(options);
      while (!run.finished()) {
        const RunEvent event = run.advance();
        ASSERT_NE(event, RunEvent::gave_up) << run.report().blocking;
        const State<2> state = run.state();
        expect_measured(state);
        if (event == RunEvent::equilibrium) {
          EXPECT_EQ(state.n_negative, stability(state.packing).n_negative);
          run.saved("");
          continue;
        }
        EXPECT_EQ(state.n_negative, -1);
        State<2> released = run.release_state();
        expect_measured(released);
        run.restore_packing(std::move(released.packing));
      }
    }
}

/// Returns the root mean square speed at the start of a run. The run starts from a saved packing of disks. The largest
/// disk has the diameter a = 1 and the mass m = 1.
double starting_speed(const Law& law, double agitation, double pressure) {
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
  Law law = test::cohesive_law();
  EXPECT_EQ(starting_speed(law, 0.0, 0.5), 0.0);
  EXPECT_NEAR(starting_speed(law, 0.3, 0.5), 0.3 * std::sqrt(1.0 * 1e-3), 1e-14);  // sqrt(F0 D0/m)
  law += test::changed("adhesion.range", 0.0);
  EXPECT_NEAR(starting_speed(law, 0.3, 0.5), 0.3 * std::sqrt(0.5), 1e-14);  // sqrt(P a^2/m)
  law += test::without("adhesion");
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
