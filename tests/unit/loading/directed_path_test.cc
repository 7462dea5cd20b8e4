#include <gtest/gtest.h>

#include <cmath>

#include "floc/loading/run.h"
#include "floc/packing/balance.h"
#include "floc/scene/read_scene.h"
#include "floc/structure/elastic_energy.h"
#include "support/dynamics.h"
#include "support/scene_text.h"

namespace floc {
namespace {

AxisLoad stress(double end) {
  return {AxisLoad::stress, end};
}
AxisLoad strain(double end) {
  return {AxisLoad::strain, end};
}

TEST(LoadTarget, CountsFromTheStartOfItsTurn) {
  const StageReference turn{"axes", 1, {2.0, 3.0, 4.0}, {1.0, 0.0, 5.0}};
  const LoadTarget<3> half = load_target<3>({{stress(4.0), 0.5}, {stress(4.0), 0.5}, {strain(0.2), 0.5}}, turn);
  EXPECT_DOUBLE_EQ(half.stress[0], 2.0);  // geometric mean, since both stresses are positive
  EXPECT_DOUBLE_EQ(half.stress[1], 2.0);  // arithmetic mean, since the path starts at zero
  EXPECT_DOUBLE_EQ(half.side[2], 4.0 * std::exp(-0.1));
  EXPECT_TRUE(half.strained(2) && !half.strained(0) && !half.strained(1));
  const LoadTarget<3> end =
      load_target<3>({{stress(4.0)}, {{AxisLoad::kept_stress, 0.0}}, {strain(0.0)}}, turn);
  EXPECT_EQ(end.stress, Vec<3>(4.0, 0.0, 0.0));
  EXPECT_EQ(end.side, Vec<3>(0.0, 0.0, 4.0));
}

std::string scene_of(const std::string& load) {
  return test::scene_text("disks") + "friction = 0.0\n" + load;
}

std::vector<State<2>> states_of(const std::string& load) {
  floc::Run<2> run(parse_scene(scene_of(load), "s.toml", "."));
  std::vector<State<2>> states;
  while (!run.finished()) {
    const RunEvent event = run.advance();
    EXPECT_NE(event, RunEvent::gave_up) << run.report().blocking;
    if (event == RunEvent::gave_up) break;
    if (event != RunEvent::equilibrium) continue;
    states.push_back(run.state());
    run.saved("");
  }
  return states;
}

TEST(DirectedPath, EqualStressesOnEveryAxisHaveTheBitsOfAPressure) {
  const auto pressure = states_of("[[load]]\nto = 3.0\nsteps = 2\n");
  const auto axes =
      states_of("[[load]]\ncontrol = \"axes\"\naxes = [{stress = 3.0}, {stress = 3.0}]\nsteps = 2\n");
  ASSERT_EQ(pressure.size(), 3u);
  ASSERT_EQ(axes.size(), 3u);
  test::expect_same_bits(pressure.back().packing, axes.back().packing);
}

Vec<2> sides(const State<2>& state) {
  return state.packing.cell.matrix.diagonal();
}

TEST(DirectedPath, ImposesWhatItsTurnsSay) {
  const auto states = states_of(R"([[load]]
control = "oedometric"
to = 2.0
steps = 2
[[load]]
control = "triaxial"
axis = 1
strain = 0.01
strain_step = 5e-3
[[load]]
control = "constant_volume"
strain = -4e-3
steps = 1
[[load]]
to = 1.5
steps = 2
)");
  ASSERT_EQ(states.size(), 8u);
  for (int k = 1; k <= 2; ++k) {
    EXPECT_EQ(states[k].path.branch, "load");
    EXPECT_EQ(states[k].path.turn.control, "oedometric");
    EXPECT_EQ(sides(states[k])[0], sides(states[0])[0]);
    EXPECT_EQ(states[k].target_side, Vec<2>(sides(states[0])[0], 0.0));
    EXPECT_NEAR(states[k].stress(1, 1), std::pow(2.0, 0.5 * k), 1e-4);
    // on the axis of fixed length, the target is the present stress
    EXPECT_EQ(states[k].target_stress[0], states[k].stress(0, 0));
  }
  const double kept = states[2].target_stress[1];
  EXPECT_EQ(kept, 2.0);
  for (int k = 3; k <= 4; ++k) {
    EXPECT_EQ(states[k].target_stress[1], kept);
    EXPECT_NEAR(sides(states[k])[0] / sides(states[2])[0], std::exp(-5e-3 * (k - 2)), 1e-13);
  }
  EXPECT_NEAR(sides(states[5]).prod() / sides(states[4]).prod(), 1.0, 1e-13);
  EXPECT_NEAR(sides(states[5])[1] / sides(states[4])[1], std::exp(4e-3), 1e-13);
  EXPECT_EQ(states[7].target_stress, Vec<2>(1.5, 1.5));
  EXPECT_TRUE(states[7].target_side.isZero(0.0));
}

/// The strain of this single load step is too large for Newton's method, so time steps have to impose it.
TEST(DirectedPath, LargeStrainsOfOneStepAreImposed) {
  const auto states = states_of("[[load]]\ncontrol = \"triaxial\"\nstrain = 0.08\nsteps = 1\n");
  ASSERT_EQ(states.size(), 2u);
  EXPECT_NEAR(sides(states[1])[1] / sides(states[0])[1], std::exp(-0.08), 1e-13);
  EXPECT_GT(states[1].path.n_steps, states[0].path.n_steps);
}

/// Shears the sample in twelve steps. The shear is so large that the tilt of the lattice has to be reduced.
TEST(DirectedPath, ASimpleShearGoesOnWhileItsLatticeIsReduced) {
  const auto states = states_of("[[load]]\ncontrol = \"simple_shear\"\nstrain = 1.2\nsteps = 12\n");
  ASSERT_EQ(states.size(), 13u);
  const Vec<2> first = sides(states[0]);
  const double kept = states[0].target_stress[1];
  bool was_reduced = false;
  double resists = 0.0;
  for (int k = 1; k <= 12; ++k) {
    const State<2>& state = states[k];
    EXPECT_EQ(state.path.turn.control, "simple_shear");
    EXPECT_NEAR(state.path.turn.shear, 0.1 * k, 1e-14);
    EXPECT_NEAR(sides(state)[0] / first[0], 1.0, 1e-13);
    EXPECT_NEAR(state.stress(1, 1), kept, 1e-4);
    ASSERT_TRUE(state.target_offset.has_value());
    const double offset = state.packing.cell.matrix(1, 0);
    EXPECT_NEAR(offset, state.target_offset->offset, 1e-12);
    EXPECT_LE(std::abs(offset), 0.5 * first[0] + 0.1 * first[1] + 1e-12);
    const double lengths = (0.1 * k * first[1] - offset) / first[0];
    EXPECT_NEAR(lengths, std::round(lengths), 1e-11) << k;
    was_reduced = was_reduced || std::round(lengths) > 0.0;
    resists -= state.stress(0, 1) / 12;
  }
  EXPECT_TRUE(was_reduced);
  EXPECT_GT(resists, 0.05 * kept);
}

double energy(const State<2>& state) {
  return elastic_energy_per_grain(state.packing) * state.packing.grains.size();
}

/// In each step, the work of the boundary is at least the increase of the stored energy. Friction dissipates
/// the rest.
TEST(DirectedPath, DissipatesAndNeverGains) {
  const auto states = states_of("[[load]]\ncontrol = \"triaxial\"\nstrain = 0.02\nstrain_step = 1e-3\n");
  ASSERT_EQ(states.size(), 21u);
  double total = 0.0;
  for (std::size_t k = 1; k < states.size(); ++k) {
    const State<2>&from = states[k - 1], &to = states[k];
    double work = 0.0;
    for (int a = 0; a < 2; ++a)
      work += 0.5 *
              (from.stress(a, a) * from.packing.cell.volume() + to.stress(a, a) * to.packing.cell.volume()) *
              std::log(sides(from)[a] / sides(to)[a]);
    const double dissipated = work - (energy(to) - energy(from));
    // The work is computed with the mean stress of the two states. If the stress collapses between them, the error of
    // the work is at most half of the change of stress times the strain increment times the volume.
    const double open = 0.5 * (to.stress - from.stress).cwiseAbs().maxCoeff() * 1e-3 * to.packing.cell.volume();
    EXPECT_GT(dissipated, -open) << k;
    total += dissipated;
  }
  EXPECT_GT(total, 0.0);
}

}  // namespace
}  // namespace floc
