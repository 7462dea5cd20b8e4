#include "floc/relaxation/contact_dynamics_relaxer.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "floc/elasticity/indeterminacy.h"
#include "floc/packing/contact_order.h"
#include "floc/rigid/static_forces.h"
#include "support/force_components.h"
#include "support/isostatic.h"
#include "support/rigid_gas.h"

namespace floc::test {
namespace {

ShapeOptions polygons(int sides) {
  return {.kind = PolygonOptions{sides}};
}

ShapeOptions cut_stones() {
  return {.kind = CutOptions{}, .count = 10};
}

TEST(ContactDynamicsRelaxer, FrictionlessDisksAreIsostatic) {
  expect_isostatic<2>();
}

TEST(ContactDynamicsRelaxer, FrictionlessPentagonsAreNearlyIsostatic) {
  for (const std::uint64_t seed : {3u, 5u}) expect_nearly_isostatic<2>(polygons(5), 60, seed, 0.92);
}

TEST(ContactDynamicsRelaxer, FrictionlessPolyhedraAreNearlyIsostatic) {
  for (const std::uint64_t seed : {1u, 2u, 3u})
    expect_nearly_isostatic<3>({.kind = CutOptions{}}, 20, seed, 0.94);
}

TEST(ContactDynamicsRelaxer, FrictionlessSpheresAreIsostatic) {
  expect_isostatic<3>();
}

/// Expects results that are identical, bit for bit, for several numbers of threads. The results must also be identical
/// if a new relaxer is created after each chunk of steps.
template <int Dim>
void expect_repeatable(const RigidGas& gas) {
  const Packing<Dim> start = make_rigid_gas<Dim>(gas);
  const RigidEnd<Dim> whole = relaxed<Dim>(start);
  EXPECT_EQ(whole.status, RelaxationStatus::converged) << whole.reason;
  expect_same(whole, relaxed<Dim>(start, rigid_options(), true));
  for (const int threads : {2, 4}) {
    RelaxationOptions options = rigid_options();
    options.threads = threads;
    expect_same(whole, relaxed<Dim>(start, options));
  }
}

/// Without friction, the columns of the grains in the rigidity matrix are independent by the residual forces only.
template <int Dim>
void expect_counted_indeterminacy(const std::optional<ShapeOptions>& shape, int count, std::uint64_t n_seeds) {
  for (std::uint64_t seed = 1; seed <= n_seeds; ++seed) {
    const RigidEnd<Dim> end = relaxed<Dim>(make_rigid_gas<Dim>({.count = count, .shape = shape, .seed = seed}));
    if (end.status != RelaxationStatus::converged) continue;
    const double smallest = 1e-5 * mean_repulsive_force(end.packing);
    const int degree = rigid_indeterminacy(end.packing, smallest).degree;
    EXPECT_EQ(degree, counted_indeterminacy(end.packing, false, smallest)) << "seed " << seed;
    EXPECT_GE(degree, 0) << "seed " << seed;
  }
}

TEST(ContactDynamicsRelaxer, IndeterminacyOfFrictionlessPackingsIsCounted) {
  expect_counted_indeterminacy<2>(std::nullopt, 40, 6);
  expect_counted_indeterminacy<3>(std::nullopt, 30, 4);
  expect_counted_indeterminacy<2>(polygons(5), 24, 3);
  expect_counted_indeterminacy<3>(cut_stones(), 12, 1);
}

TEST(ContactDynamicsRelaxer, DisksRepeatTheirBits) {
  expect_repeatable<2>({.count = 300, .friction = 0.5});
}

TEST(ContactDynamicsRelaxer, PentagonsRepeatTheirBits) {
  expect_repeatable<2>({.count = 60, .shape = polygons(5), .friction = 0.5});
}

TEST(ContactDynamicsRelaxer, SpheresRepeatTheirBits) {
  expect_repeatable<3>({.count = 60, .friction = 0.3});
}

TEST(ContactDynamicsRelaxer, PolyhedraRepeatTheirBits) {
  expect_repeatable<3>({.count = 20, .shape = cut_stones(), .friction = 0.5});
}

TEST(ContactDynamicsRelaxer, FrictionlessPolyhedraRepeatTheirBits) {
  expect_repeatable<3>({.count = 12, .shape = cut_stones()});
}

/// Compresses a gas in a cell of 300 times the mass of all grains. A cell of this mass is as slow as that of thousands
/// of grains, since the mass of a cell is proportional to the number of grains.
template <int Dim>
RigidEnd<Dim> compressed_by_heavy_cell(const RigidGas& gas) {
  RelaxationOptions options = rigid_options();
  options.cell_mass = 300.0;
  const RigidEnd<Dim> end = relaxed(make_rigid_gas<Dim>(gas), options);
  expect_at_rest(end);
  return end;
}

// The gas in a heavy cell is calm at first.
TEST(ContactDynamicsRelaxer, HeavyCellsCompressGases) {
  compressed_by_heavy_cell<2>({.count = 40, .friction = 0.5});
  compressed_by_heavy_cell<2>({.count = 20, .shape = polygons(5), .friction = 0.5});
  compressed_by_heavy_cell<2>({.count = 40, .friction = 0.5, .adhesion = 0.1});
  compressed_by_heavy_cell<3>({.count = 30, .friction = 0.5});
  compressed_by_heavy_cell<3>({.count = 10, .shape = cut_stones(), .friction = 0.5});
}

// If sweeps alone adapted the impulses to the motion of a heavy cell, the stress would fluctuate and shake the packing:
// these gases took 11'000 to more than 40'000 steps.
TEST(ContactDynamicsRelaxer, HeavyCellsDoNotShakePackings) {
  for (const std::uint64_t seed : {2u, 3u, 4u, 5u}) {
    const RigidGas gas{.count = 60, .least = 0.25, .friction = 0.5, .seed = seed};
    EXPECT_LT(compressed_by_heavy_cell<2>(gas).report.n_steps, 8000) << "seed " << seed;
  }
}

TEST(ContactDynamicsRelaxer, FrictionlessPolyhedraBalanceWithEveryFinish) {
  for (const RigidForces forces : {RigidForces::closest, RigidForces::canonical, RigidForces::stepped}) {
    RelaxationOptions options = rigid_options();
    options.contact_dynamics.forces = forces;
    const RigidEnd<3> end = relaxed<3>(make_rigid_gas<3>({.count = 12, .shape = cut_stones()}), options);
    expect_at_rest(end);
    EXPECT_EQ(end.report.ending, forces == RigidForces::canonical ? "canonical" : "closest");
  }
}

TEST(ContactDynamicsRelaxer, RoundedPolyhedraComeToRestWithoutFriction) {
  for (const double rounding : {0.05, 0.15}) {
    SCOPED_TRACE(rounding);
    ShapeOptions shape = cut_stones();
    shape.rounding = rounding;
    expect_at_rest(relaxed<3>(make_rigid_gas<3>({.count = 12, .shape = shape})));
  }
}

/// Relaxes packings of disks and reads the progress after each chunk of steps. Expects that steps at rest are never
/// longer than at their beginning, that the count of calm steps begins at -160 after a failed search for balanced
/// forces, and that it has reached 40 whenever the motion ends.
TEST(ContactDynamicsRelaxer, DisksMoveOnAfterAFailedSearch) {
  int n_failed = 0;
  for (const std::uint64_t seed : {3u, 9u}) {
    SCOPED_TRACE(seed);
    ContactDynamicsRelaxer<2> relaxer(rigid_options(),
                                      make_rigid_gas<2>({.count = 250, .friction = 0.5, .seed = seed}),
                                      LoadTarget<2>::normal_stress(Vec<2>::Ones()));
    RelaxationStatus status = RelaxationStatus::running;
    for (int phase = ContactDynamicsProgress::moving; status == RelaxationStatus::running;) {
      status = relaxer.advance();
      const nlohmann::json now = nlohmann::json::parse(relaxer.progress());
      const int calm = now["calm_steps"];
      EXPECT_LE(now["rest_length"], 0.125);
      const bool ended_motion = phase == ContactDynamicsProgress::moving && now["phase"] != phase;
      const bool failed = phase == ContactDynamicsProgress::resting && now["phase"] != phase;
      if (ended_motion) {
        EXPECT_GE(calm, 40);
      }
      if (failed) {
        EXPECT_EQ(calm, -160);
      }
      n_failed += failed;
      phase = now["phase"];
      // Steps at rest do not advance the simulated time; their number is told in its place.
      const int n_resting = phase == ContactDynamicsProgress::resting ? int(now["resting_steps"]) : 0;
      EXPECT_EQ(relaxer.report().n_resting_steps, n_resting);
    }
    EXPECT_EQ(status, RelaxationStatus::converged) << relaxer.report().blocking;
    expect_verified(relaxer.packing());
  }
  EXPECT_GT(n_failed, 0);
}

/// Removes the forces of a packing and computes canonical forces from its positions alone. These must equal the
/// canonical forces at the end of the relaxation.
TEST(ContactDynamicsRelaxer, CanonicalForcesDependOnPositionsAlone) {
  RelaxationOptions options = rigid_options();
  options.contact_dynamics.forces = RigidForces::canonical;
  const RigidEnd<2> end = relaxed<2>(make_rigid_gas<2>({.count = 60, .friction = 0.5}), options);
  expect_at_rest(end);
  Packing<2> stripped = end.packing;
  for (Contact<2>& c : stripped.contacts) {
    c.normal_force = c.elastic_force = 0.0;
    c.shear_force.setZero();
  }
  ForceBalanceOptions<2> balance;
  balance.axis_stress = Vec<2>::Ones();
  const BalancedForces<2> again = StaticForces<2>("the packing", stripped, balance).canonical();
  for (std::size_t k = 0; k < stripped.contacts.size(); ++k) {
    EXPECT_NEAR(again.normal_force[k], end.packing.contacts[k].normal_force, 1e-8);
    EXPECT_LT((again.shear_force[k] - end.packing.contacts[k].shear_force).norm(), 1e-8);
  }
}

TEST(ContactDynamicsRelaxer, SteppedForcesBalanceOrGiveAReason) {
  RelaxationOptions options = rigid_options();
  options.contact_dynamics.forces = RigidForces::stepped;
  const RigidEnd<2> end = relaxed<2>(make_rigid_gas<2>({.count = 40, .friction = 0.5}), options);
  EXPECT_NE(end.status, RelaxationStatus::running);
  expect_at_rest_or_reason(end);
  if (end.status == RelaxationStatus::converged) {
    EXPECT_EQ(end.report.ending, "stepped");
  }
}

TEST(ContactDynamicsRelaxer, ReportsCountsOfSteps) {
  const RigidEnd<2> end = relaxed<2>(make_rigid_gas<2>({.count = 100, .friction = 0.5}));
  EXPECT_EQ(end.report.counts.n_steps, end.report.n_steps);
  EXPECT_GT(end.report.counts.n_sweeps, end.report.n_steps);
  EXPECT_LT(20 * end.report.counts.n_unfinished, end.report.n_steps);
  EXPECT_GT(end.report.counts.deepest_overlap, 0.0);
  EXPECT_LE(end.report.counts.deepest_overlap, 1e-2);
}

}  // namespace
}  // namespace floc::test
