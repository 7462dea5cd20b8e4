#include "floc/elasticity/stability.h"

#include <gtest/gtest.h>

#include "floc/elasticity/moduli.h"
#include "floc/network/free_motions.h"
#include "floc/packing/balance.h"
#include "support/contact_laws.h"
#include "support/lattices.h"

namespace floc {
namespace {

/// Law with a strong attraction of long range. Some packings under this law are unstable in one or many modes.
Law tail_law(double force) {
  Law law = test::elastic_law(1.0, 0.7, 0.05);
  law += test::tail_adhesion(force, 0.08);
  return law;
}

int count_with_moduli(const auto& packing, bool prestress) {
  ModuliOptions options;
  options.prestress = prestress;
  return elastic_moduli(packing, options).n_negative;
}

template <int Dim>
void expect_inertia_of_the_moduli(int n_grains, double grains_per_volume) {
  int n_unstable = 0;
  for (unsigned seed = 0; seed < 12; ++seed)
    for (const double force : {0.0, 0.004, 0.02, 0.08})
      for (const bool prestress : {false, true}) {
        const auto packing = test::random_packing<Dim>(n_grains, seed, tail_law(force), grains_per_volume);
        const int expected = count_with_moduli(packing, prestress);
        EXPECT_EQ(stability(packing, prestress).n_negative, expected) << seed << " " << force;
        n_unstable += expected > 0;
      }
  EXPECT_GT(n_unstable, 10);
}

TEST(Stability, CountsWhatTheModuliCountIn2D) {
  expect_inertia_of_the_moduli<2>(20, 1.6);
  expect_inertia_of_the_moduli<2>(20, 0.9);  // loose packings with dead ends and single contacts at a distance
}

TEST(Stability, CountsWhatTheModuliCountIn3D) {
  expect_inertia_of_the_moduli<3>(10, 1.6);
  expect_inertia_of_the_moduli<3>(12, 0.9);
}

/// Tests the method without factorization: it must find a negative eigenvalue if and only if the factorization counts
/// at least one. The method could miss negative eigenvalues that are very close to zero, but these packings have
/// none.
template <int Dim>
void expect_sign_of_the_inertia(int n_grains, double grains_per_volume) {
  StabilityOptions iterative;
  iterative.largest_factor = 0.0;
  int n_unstable = 0;
  for (unsigned seed = 0; seed < 12; ++seed)
    for (const double force : {0.0, 0.004, 0.02, 0.08})
      for (const bool prestress : {false, true}) {
        const auto packing = test::random_packing<Dim>(n_grains, seed, tail_law(force), grains_per_volume);
        const int expected = *stability(packing, prestress).n_negative;
        const Stability found = stability(packing, prestress, iterative);
        ASSERT_TRUE(found.n_negative.has_value());
        EXPECT_EQ(*found.n_negative > 0, expected > 0) << seed << " " << force << " " << found.note;
        n_unstable += expected > 0;
      }
  EXPECT_GT(n_unstable, 10);
}

TEST(Stability, IsSeenWithoutAFactor) {
  expect_sign_of_the_inertia<2>(20, 1.6);
  expect_sign_of_the_inertia<2>(20, 0.9);
  expect_sign_of_the_inertia<3>(12, 0.9);
}

TEST(Stability, ThatIsTooDearToTestIsSaidToBeUnknownAndRefusesNothing) {
  StabilityOptions nothing;
  nothing.most_operations = 1e3;
  const auto packing = test::random_packing<3>(12, 0, tail_law(0.004), 1.6);
  const Stability found = stability(packing, true, nothing);
  EXPECT_FALSE(found.n_negative.has_value());
  EXPECT_TRUE(found.may_be_stable());
  EXPECT_NE(found.note.find("not tested: a factor of the stiffness matrix would take"), std::string::npos)
      << found.note;
  EXPECT_TRUE(stability(packing, true).n_negative.has_value());
}

TEST(Stability, DoesNotCountMechanisms) {
  // Without tangential springs, a square lattice can be sheared without energy. A chain does not resist a strain across
  // the chain.
  const Law bare = test::elastic_law(1.0, 0.0, 0.0);
  EXPECT_EQ(stability(test::square_frames(4, 1.0, bare)).n_negative, 0);
  EXPECT_EQ(stability(test::chain_across(5, 1.0, 2.0, bare)).n_negative, 0);
}

TEST(Moduli, OfANetworkAreThoseOfItsPacking) {
  const Packing<2> packing = test::random_packing<2>(20, 3, tail_law(0.004));
  ModuliOptions options;
  options.prestress = true;
  NetworkLoad<2> load;
  load.stress = static_stress(packing);
  const Moduli m = elastic_moduli(options.loaded_network(packing), load, options);
  const Moduli expected = elastic_moduli(packing, options);
  EXPECT_EQ((m.C - expected.C).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(m.bounds.B_reuss, expected.bounds.B_reuss);
  EXPECT_EQ(m.n_negative, expected.n_negative);
}

}  // namespace
}  // namespace floc
