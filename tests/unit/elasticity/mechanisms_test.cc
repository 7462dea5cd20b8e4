#include "floc/elasticity/mechanisms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <numbers>

#include "support/lattices.h"

namespace floc {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

template <int Dim>
StrainMechanisms mechanisms_of(const ContactNetwork<Dim>& network, StrainSet strains) {
  ResponseOptions options;
  options.strains = strains;
  return strain_mechanisms<Dim>(elastic_response(network, options), affine_stiffness(network, strains));
}

TEST(StrainMechanisms, OfAChainLeaveTheOtherAxisFree) {
  const auto network = contact_network(test::chain_across(4, 1.0, 3.0, test::elastic_law(1.0, 0.5, 0.1)));
  const StrainMechanisms found = mechanisms_of(network, StrainSet::diagonal);
  ASSERT_EQ(found.strains.cols(), 1);
  EXPECT_NEAR(std::abs(found.strains(1, 0)), 1.0, 1e-12);
  // The mechanism is a strain along the second axis. An isotropic stress does work on this strain, so the modulus B_S
  // vanishes too.
  EXPECT_THAT(found.vanishing, ElementsAre("C22", "B_S"));
}

TEST(StrainMechanisms, OfAFrictionlessSquareLatticeIsItsShear) {
  const auto network = contact_network(test::square_frames(2, 1.0, test::elastic_law(1.0, 0.0, 0.0)));
  EXPECT_EQ(mechanisms_of(network, StrainSet::diagonal).strains.cols(), 0);
  EXPECT_THAT(mechanisms_of(network, StrainSet::full).vanishing, ElementsAre("C33"));
}

TEST(StrainMechanisms, ThatShearTheCellLeaveTheExtensionsStiff) {
  // The disks of an oblique lattice without friction touch along its two lattice vectors. The angle between these can
  // change at no cost, which both extends and shears the cell. Without shear, no extension is free.
  Packing<2> packing = test::triangular(1.0, test::elastic_law(1.0, 0.0, 0.0));
  const double angle = 75.0 * std::numbers::pi / 180.0;
  packing.cell.matrix << 0.999, 0.0, 0.999 * std::cos(angle), 0.999 * std::sin(angle);
  find_contacts(packing);
  const auto network = contact_network(packing);
  ASSERT_EQ(network.contacts.size(), 2u);
  const StrainMechanisms found = mechanisms_of(network, StrainSet::full);
  EXPECT_EQ(found.strains.cols(), 1);
  EXPECT_THAT(found.vanishing, IsEmpty());
}

TEST(StrainMechanisms, OfABraceAtFortyFiveDegreesIsPureShear) {
  // There is only one contact, along (1, 1). The contact resists compression, but not the shear strain that defines G.
  Packing<2> packing = test::triangular(1.0, test::elastic_law(1.0, 0.0, 0.0));
  packing.cell.matrix << 1.0, 1.0, -2.0, 2.0;
  packing.cell.matrix *= std::sqrt(0.5);
  find_contacts(packing);
  const auto network = contact_network(packing);
  ASSERT_EQ(network.contacts.size(), 1u);
  const StrainMechanisms found = mechanisms_of(network, StrainSet::diagonal);
  EXPECT_THAT(found.vanishing, ElementsAre("G"));
}

TEST(StrainMechanisms, MoveTheGrainsAtNoCost) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto network =
        contact_network(test::random_packing<2>(25, seed, test::elastic_law(1.0, 0.6, 0.0), 1.1));
    const StrainMechanisms found = mechanisms_of(network, StrainSet::full);
    if (found.strains.cols() == 0) continue;
    Eigen::MatrixXd motion(network.n_unknowns() + 3, found.strains.cols());
    motion << found.motions, found.strains;
    const FreeMotions free = find_free_motions(network);
    // A dead end moves together with the grain to which it is attached. The motions in the response do not contain dead
    // ends, so this test removes them from the network.
    const auto core = without_grains(network, free.dead_end);
    EXPECT_LT((scaled_rigidity_matrix(core, StrainSet::full) * motion).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(StructuralMechanisms, AreTheNullSpaceOfRandomNetworks) {
  int n_mechanisms = 0, n_coupled = 0;
  for (unsigned seed = 0; seed < 40; ++seed)
    for (const double density : {1.0, 1.4, 2.0}) {
      const auto network =
          contact_network(test::random_packing<2>(25, seed, test::elastic_law(1.0, 0.6, 0.0), density));
      ResponseOptions options;
      options.strains = StrainSet::full;
      const ElasticResponse response = elastic_response(network, options);
      const StructuralMechanisms found = structural_mechanisms(network, StrainSet::full);
      EXPECT_EQ(found.n_mechanisms, response.n_mechanisms) << "seed " << seed;
      EXPECT_EQ(found.n_coupled, mechanisms_of(network, StrainSet::full).strains.cols()) << "seed " << seed;
      n_mechanisms += found.n_mechanisms;
      n_coupled += found.n_coupled;
    }
  EXPECT_GT(n_mechanisms, 20);
  EXPECT_GT(n_coupled, 20);
}

TEST(StructuralMechanisms, AreNotThoseOfACoincidence) {
  // A network of one node and two chains of n - 2 hinged disks. Its 3 (2n - 3) unknowns minus its 4 (n - 1) conditions
  // minus its 2 translations give the number of mechanisms, if no three disks of a chain lie exactly on a line. On a
  // straight line, two of the conditions are redundant (one for n = 3), so there are more mechanisms.
  for (const auto& [n, by_count, straight] : {std::array{3, 0, 1}, {4, 1, 3}, {5, 3, 5}}) {
    const auto network = contact_network(test::square_frames(n, 1.0, test::elastic_law(1.0, 0.6, 0.0)));
    EXPECT_EQ(structural_mechanisms(network, StrainSet::diagonal).n_mechanisms, by_count) << n;
    EXPECT_EQ(elastic_response(network, {}).n_mechanisms, straight) << n;
  }
}

}  // namespace
}  // namespace floc
