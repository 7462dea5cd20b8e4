#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floc/elasticity/moduli.h"
#include "support/lattices.h"
#include "support/network_packings.h"

namespace floc {
namespace {

Moduli by_method(const Packing<2>& packing, ModuliMethod method, double tolerance) {
  ModuliOptions options;
  options.method = method;
  options.tolerance = tolerance;
  return elastic_moduli(packing, options);
}

/// Returns the packing without n of its contacts, as if it were a later state of the same path that has lost contacts.
Packing<2> with_contacts_lost(Packing<2> packing, int n) {
  packing.contacts.erase(packing.contacts.begin() + 5, packing.contacts.begin() + 5 + n);
  return packing;
}

/// Expects that the differences of moduli from the exact moduli are at most the sum of the two error bounds.
void expect_within_errors(const Moduli& m, const Moduli& exact) {
  EXPECT_LE(std::abs(m.B - exact.B), m.B_error + exact.B_error);
  EXPECT_LE(std::abs(m.G - exact.G), m.G_error + exact.G_error);
}

TEST(ModuliMethod, AFactorInSinglePrecisionIsRefinedToTheDigitsAskedFor) {
  const Packing<2> packing = test::random_packing<2>(200, 3, test::elastic_law(1.0, 0.8, 0.01));
  const Moduli exact = by_method(packing, ModuliMethod::factor, 1e-10);
  for (const double tolerance : {1e-3, 1e-6, 1e-10}) {
    const Moduli m = by_method(packing, ModuliMethod::single_factor, tolerance);
    EXPECT_EQ(m.method, ModuliMethod::single_factor);
    EXPECT_GT(m.B_error, 0.0);
    EXPECT_LE(m.B_error, tolerance * m.B);
    EXPECT_TRUE(std::isnan(m.condition));  // this method does not estimate the condition number
    expect_within_errors(m, exact);
  }
}

TEST(ModuliMethod, IterationFromTheLastStateKeepsItsFactorAndTellsItsError) {
  const Packing<2> first = test::random_packing<2>(200, 4, test::elastic_law(1.0, 0.8, 0.01));
  ModuliOptions options;
  options.method = ModuliMethod::iterative;
  options.tolerance = 1e-4;
  ModuliSequence<2> sequence(options);
  // the first state has no earlier factorization to start from
  EXPECT_EQ(sequence.next(first, false).method, ModuliMethod::factor);
  for (const int n_lost : {0, 1, 3}) {
    const Packing<2> packing = with_contacts_lost(first, n_lost);
    const Moduli m = sequence.next(packing, false);
    EXPECT_EQ(m.method, ModuliMethod::iterative) << n_lost;
    EXPECT_TRUE(std::isnan(m.condition));
    EXPECT_LE(m.B_error, options.tolerance * m.B);
    expect_within_errors(m, by_method(packing, ModuliMethod::factor, 1e-10));
  }
}

TEST(ModuliMethod, IterationFactorizesAPackingThatIsAnother) {
  const Law law = test::elastic_law(1.0, 0.8, 0.01);
  ModuliOptions options;
  options.method = ModuliMethod::iterative;
  ModuliSequence<2> sequence(options);
  (void)sequence.next(test::random_packing<2>(200, 5, law), false);
  for (const Packing<2>& other : {test::random_packing<2>(200, 6, law), test::random_packing<2>(150, 6, law)}) {
    const Moduli m = sequence.next(other, false);
    EXPECT_EQ(m.method, ModuliMethod::factor);
    EXPECT_EQ(m.B, elastic_moduli(other, {}).B);
  }
}

TEST(ModuliMethod, TheMiddleBetweenTheBoundsIsOffByHalfTheirDistanceAtMost) {
  const Packing<2> packing = test::random_packing<2>(100, 7, test::elastic_law(1.0, 0.8, 0.01));
  const Moduli exact = by_method(packing, ModuliMethod::factor, 1e-10);
  // For a packing without loads, the lower bound of B is zero. This is correct even if the forces of the packing are
  // not in balance, as here.
  ModuliOptions options;
  options.method = ModuliMethod::bounds;
  options.unloaded = true;
  const Moduli m = elastic_moduli(packing, options);
  EXPECT_EQ(m.bounds.B_voigt, exact.bounds.B_voigt);
  EXPECT_DOUBLE_EQ(m.B + m.B_error, m.bounds.B_voigt);
  EXPECT_DOUBLE_EQ(m.B - m.B_error, m.bounds.B_reuss);
  EXPECT_DOUBLE_EQ(m.G + m.G_error, m.bounds.G_voigt);
  EXPECT_EQ(m.G, m.G_error);
  expect_within_errors(m, exact);
  EXPECT_TRUE(std::isnan(m.C(0, 0)));
  EXPECT_EQ(m.method, ModuliMethod::bounds);
}

/// Computes the moduli by the method `bounds` for a crystal in which one contact was changed.
Moduli bounds_of_changed(void (*change)(NetworkContact<2>&)) {
  const Packing<2> packing = test::triangular_crystal(4, 0.999, test::elastic_law(1.0, 0.7, 0.03));
  ModuliOptions options;
  options.method = ModuliMethod::bounds;
  ContactNetwork<2> network = options.loaded_network(packing);
  change(network.contacts.front());
  return elastic_moduli(network, network_load(packing, false), options);
}

TEST(ModuliMethod, BoundsFailWithAReasonWhereTheyAreNone) {
  using Contact = NetworkContact<2>;
  EXPECT_TRUE(bounds_of_changed([](Contact&) {}).failure.empty());
  const std::pair<void (*)(Contact&), const char*> changes[] = {
      {[](Contact& c) { c.kn = -1e-3; }, "contacts have a negative stiffness"},
      {[](Contact& c) { c.kt = -1e-3; }, "contacts have a negative stiffness"},
      {[](Contact& c) { c.kr = -1e-3; }, "contacts have a negative stiffness"},
      {[](Contact& c) { c.distant = true; }, "attractions across gaps"},
      {[](Contact& c) { c.normal_force *= 1.01; }, "the contact forces do not balance"},
      {[](Contact& c) { c.rolling_moment[0] += 0.1 * c.normal_force; }, "the contact forces do not balance"}};
  for (const auto& [change, reason] : changes) {
    const Moduli m = bounds_of_changed(change);
    EXPECT_THAT(m.failure, testing::HasSubstr(reason));
    EXPECT_FALSE(m.bounds_hold() || m.bounds_hold_B_S());
    EXPECT_TRUE(std::isnan(m.B) && std::isnan(m.B_error) && std::isnan(m.B_S) && std::isnan(m.G));
  }
}

}  // namespace
}  // namespace floc
