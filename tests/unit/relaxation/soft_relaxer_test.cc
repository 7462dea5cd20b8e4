#include "floc/relaxation/soft_relaxer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <tuple>

#include "floc/contact/softened_law.h"
#include "floc/neighbors/find_contacts.h"
#include "floc/packing/balance.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/relaxation/softening.h"
#include "support/contact_laws.h"
#include "support/dynamics.h"
#include "support/message_of.h"

namespace floc {
namespace {

RelaxationOptions soft_options(double softening) {
  RelaxationOptions o;
  o.strain_rate_cap = 0.05;
  o.softening = softening;
  return o;
}

template <int Dim>
Packing<Dim> equilibrium_of(RelaxationOptions with, const Packing<Dim>& start, double pressure) {
  const auto equilibrator = make_equilibrator<Dim>(with, start, Vec<Dim>(Vec<Dim>::Constant(pressure)));
  RelaxationStatus status = RelaxationStatus::running;
  while (status == RelaxationStatus::running) status = equilibrator->advance();
  EXPECT_EQ(status, RelaxationStatus::converged) << equilibrator->report().blocking;
  return equilibrator->release_packing();
}

const Packing<2>& disks() {
  static const Packing<2> packing =
      equilibrium_of(soft_options(1.0), test::gas_of(80, test::cohesive_law(), 0.5), 0.1);
  return packing;
}

const Packing<3>& beads() {
  static const Packing<3> packing = [] {
    const Law law = test::law_of({test::hertz(1e6, 0.3), test::critical_damping(0.9), test::mindlin(0.4)});
    RelaxationOptions with;
    with.inertial_number_cap = 0.1;
    with.tolerance = {1e-4, 1e-4, 1e-4, 1e-7};
    with.finish = Finish::dynamic;
    return equilibrium_of(with, test::gas_of<3>(60, law, 0.4), 10.0);
  }();
  return packing;
}

/// Relative changes of the forces of the contacts that two packings share, and number of contacts that exist in only
/// one of the packings.
struct Change {
  double normal = 0.0, shear = 0.0, rolling = 0.0;
  int n_unshared = 0;
};

template <int Dim>
Change change_between(const Packing<Dim>& p, const Packing<Dim>& q) {
  double normal = 0.0, shear = 0.0, rolling = 0.0;
  Change change;
  std::map<std::tuple<int, int>, const Contact<Dim>*> after;
  for (const Contact<Dim>& c : q.contacts) after[{c.i, c.j}] = &c;
  for (const Contact<Dim>& c : p.contacts) {
    const auto found = after.find({c.i, c.j});
    if (found == after.end() || found->second->distant != c.distant) {
      ++change.n_unshared;
      continue;
    }
    const Contact<Dim>& d = *found->second;
    change.normal += std::pow(d.normal_force - c.normal_force, 2);
    change.shear += (d.shear_force - c.shear_force).squaredNorm();
    change.rolling += (d.rolling_moment - c.rolling_moment).squaredNorm();
    normal += c.normal_force * c.normal_force;
    shear += c.shear_force.squaredNorm();
    rolling += c.rolling_moment.squaredNorm();
  }
  change.normal = std::sqrt(change.normal / normal);
  change.shear = std::sqrt(change.shear / shear);
  change.rolling = rolling > 0.0 ? std::sqrt(change.rolling / rolling) : 0.0;
  return change;
}

template <int Dim>
void expect_springs_below_their_caps(const Packing<Dim>& packing) {
  const double mu = packing.law.friction_coefficient();
  for (const Contact<Dim>& c : packing.contacts)
    EXPECT_LE(c.shear_force.norm(), mu * c.elastic_force * (1.0 + 1e-9));
}

TEST(ChangeOfSoftening, KeepsEveryForceOfDisksAndTheirStress) {
  const Mat<2> stress = static_stress(disks());
  Packing<2> changed = disks();
  double from = 1.0;
  for (const double to : {4.0, 10.0, 2.0, 1.0}) {  // softer in two steps, then stiffer in two steps
    const Packing<2> before = changed;
    change_softening(changed, disks().law, from, to);
    const Change change = change_between(before, changed);
    EXPECT_EQ(change.n_unshared, 0) << to;
    EXPECT_LT(change.normal, 0.03) << to;
    EXPECT_LT(change.shear, 0.03) << to;
    EXPECT_LT(change.rolling, 0.03) << to;
    EXPECT_LT((static_stress(changed) - stress).cwiseAbs().maxCoeff(), 0.02) << to;  // in units of F0/a
    expect_springs_below_their_caps(changed);
    from = to;
  }
  EXPECT_EQ(changed.law, disks().law);
  EXPECT_LT(residuals(changed, Vec<2>(0.1, 0.1)).force, 0.1);
}

TEST(ChangeOfSoftening, InPlaceChangesForcesByTheRatio) {
  Packing<2> softer = disks();
  soften_in_place(softer, disks().law, 1.0, 4.0);
  ASSERT_EQ(softer.contacts.size(), disks().contacts.size());
  for (std::size_t k = 0; k < softer.contacts.size(); ++k) {
    const Contact<2>&p = disks().contacts[k], &q = softer.contacts[k];
    EXPECT_EQ(q.history, p.history);
    EXPECT_NEAR(q.elastic_force, p.elastic_force / 4.0, 1e-12);
    EXPECT_NEAR(q.shear_force.norm(), p.shear_force.norm() / 4.0, 1e-12);
  }
  soften_in_place(softer, disks().law, 4.0, 1.0);
  for (std::size_t k = 0; k < softer.contacts.size(); ++k)
    EXPECT_EQ(softer.contacts[k].shear_force, disks().contacts[k].shear_force);
}

/// If the softening changes, the tangential force of Mindlin friction is kept, not the elongation of its spring. Normal
/// forces change more than tangential forces: beads have so many contacts that no displacements can restore all normal
/// forces.
TEST(ChangeOfSoftening, KeepsTangentialForcesOfBeads) {
  const Packing<3>& p = beads();
  ASSERT_GT(p.contacts.size(), 100u);
  Packing<3> changed = p;
  change_softening(changed, p.law, 1.0, 2.0);
  const Change change = change_between(p, changed);
  EXPECT_LE(change.n_unshared, static_cast<int>(p.contacts.size() / 20));
  EXPECT_LT(change.normal, 0.3);
  EXPECT_LT(change.shear, 0.1);
  EXPECT_NEAR(static_stress(changed).trace() / 3.0, 10.0, 0.5);
  expect_springs_below_their_caps(changed);
}

TEST(ChangeOfSoftening, InPlaceAndBackIsNoChangeForBeads) {
  Packing<3> changed = beads();
  soften_in_place(changed, beads().law, 1.0, 2.0);  // a power of two causes no rounding
  EXPECT_NE(changed.contacts.front().shear_force, beads().contacts.front().shear_force);
  soften_in_place(changed, beads().law, 2.0, 1.0);
  ASSERT_EQ(changed.contacts.size(), beads().contacts.size());
  for (std::size_t k = 0; k < changed.contacts.size(); ++k) {
    EXPECT_EQ(changed.contacts[k].history, beads().contacts[k].history);
    EXPECT_EQ(changed.contacts[k].shear_force, beads().contacts[k].shear_force);
  }
}

template <int Dim>
void expect_strict(const Packing<Dim>& packing, const Law& law, double pressure,
                   const EquilibriumTolerance& tolerance) {
  EXPECT_EQ(packing.law, law);
  EXPECT_TRUE(residuals(packing, Vec<Dim>(Vec<Dim>::Constant(pressure))).within(tolerance));
  // The law must give these forces at the positions and histories of the packing, and no contact may be missing.
  Packing<Dim> anew = packing;
  refresh_contacts(anew);
  ASSERT_EQ(anew.contacts.size(), packing.contacts.size());
  for (std::size_t k = 0; k < anew.contacts.size(); ++k)
    EXPECT_NEAR(anew.contacts[k].normal_force, packing.contacts[k].normal_force, 1e-5);
  find_contacts(anew);
  EXPECT_EQ(anew.contacts.size(), packing.contacts.size());
  EXPECT_TRUE(stability_at_rest(packing).may_be_stable());
}

TEST(SoftRelaxer, EndsInAStrictEquilibriumOfTheLaw) {
  for (const double pressure : {0.3, 3.0, 20.0})
    expect_strict(equilibrium_of(soft_options(10.0), disks(), pressure), disks().law, pressure, {});
  RelaxationOptions by_motion = soft_options(10.0);
  by_motion.finish = Finish::dynamic;
  expect_strict(equilibrium_of(by_motion, test::gas_of(60, test::cohesive_law(), 0.5), 0.1),
                test::cohesive_law(), 0.1, {});
}

TEST(SoftRelaxer, TakesBeadsToAStrictEquilibrium) {
  RelaxationOptions with;
  with.inertial_number_cap = 0.1;
  with.tolerance = {1e-4, 1e-4, 1e-4, 1e-7};
  with.finish = Finish::dynamic;
  with.softening = 30.0;
  const Packing<3> gas = test::gas_of<3>(60, beads().law, 0.4);
  const Packing<3> end = equilibrium_of(with, gas, 10.0);
  EXPECT_EQ(end.law, beads().law);
  EXPECT_TRUE(residuals(end, Vec<3>(10.0, 10.0, 10.0)).within(with.tolerance));
}

/// An elastic step is solved statically, in the same way with and without softening.
TEST(SoftRelaxer, AnElasticStepIsTheOneOfTheLaw) {
  const Packing<2> p = equilibrium_of(soft_options(1.0), disks(), 0.1005);
  const Packing<2> q = equilibrium_of(soft_options(10.0), disks(), 0.1005);
  EXPECT_EQ(p.grains.position, q.grains.position);
}

/// A new relaxer is created from the packing and the progress of the old one before every chunk of steps. The results
/// must be identical, bit for bit, to those without interruption. The test covers all stages of a relaxation, for a gas
/// and for a packing that collapses under a load.
TEST(SoftRelaxer, ContinuedFromItsProgressGivesTheSameBits) {
  for (const Packing<2>& start : {test::gas_of(60, test::cohesive_law(), 0.5), disks()}) {
    const auto target = LoadTarget<2>::normal_stress(Vec<2>(20.0, 20.0));
    SoftRelaxer<2> unbroken(soft_options(10.0), start, target);
    Packing<2> packing = start;
    std::string progress;
    RelaxationStatus status = RelaxationStatus::running;
    bool moved = false, restored = false;
    for (int k = 0; k < 2000 && status == RelaxationStatus::running; ++k) {
      status = unbroken.advance();
      SoftRelaxer<2> broken(soft_options(10.0), packing, target, progress);
      EXPECT_EQ(broken.advance(), status);
      progress = broken.progress();
      packing = broken.release_packing();
      ASSERT_EQ(progress, unbroken.progress());
      ASSERT_EQ(packing.law, start.law);
      ASSERT_EQ(packing.grains.position, unbroken.packing().grains.position);
      moved = moved || progress.find("\"soft_stage\":1") != std::string::npos;
      restored = restored || progress.find("\"soft_stage\":2") != std::string::npos;
    }
    EXPECT_EQ(status, RelaxationStatus::converged);
    EXPECT_TRUE(moved && restored);
  }
}

TEST(SoftRelaxer, RefusesWhatCannotBeSoftened) {
  const auto words = [](double softening, const Packing<2>& packing, const LoadTarget<2>& load) {
    return test::message_of([&] { SoftRelaxer<2>(soft_options(softening), packing, load); });
  };
  const auto load = LoadTarget<2>::normal_stress(Vec<2>(0.1, 0.1));
  EXPECT_NE(words(11.0, disks(), load).find("expected at most 10"), std::string::npos);
  LoadTarget<2> strained = load;
  strained.side = Vec<2>(disks().cell.matrix(0, 0), 0.0);
  EXPECT_NE(words(2.0, disks(), strained).find("a stress is imposed on every axis"), std::string::npos);
}

/// Tests soft contacts with a large range of adhesion (kappa = a K_N/F0 = 100), and very stiff contacts.
TEST(SoftRelaxer, TakesStiffnessesOfManyDecades) {
  struct Case {
    double kappa, range, softening;
  };
  for (const auto& [kappa, range, softening] : {Case{1e2, 0.5, 5.0}, Case{1e9, 1e-3, 1e5}}) {
    Law law = test::cohesive_law();
    law += test::changed("normal.stiffness", kappa);
    law += test::changed("friction.stiffness", kappa);
    law += test::changed("adhesion.range", range);
    law += test::changed("rolling.stiffness", 1e-4 * kappa);
    const Packing<2> end = equilibrium_of(soft_options(softening), test::gas_of(25, law, 0.5), 0.2);
    EXPECT_TRUE(residuals(end, Vec<2>(0.2, 0.2)).within(EquilibriumTolerance{})) << kappa;
    EXPECT_EQ(end.law, law);
  }
}

}  // namespace
}  // namespace floc
