#include "floc/elasticity/indeterminacy.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "floc/base/random.h"
#include "support/lattices.h"

namespace floc {
namespace {

/// Returns the dimension of the null space of the equilibrium matrix, which maps contact forces to loads on the grains
/// and the cell.
template <int Dim>
int self_stresses(const ContactNetwork<Dim>& network, StrainSet strains) {
  const Eigen::MatrixXd g = scaled_rigidity_matrix(network, strains);
  const auto n_components = (g.rowwise().squaredNorm().array() > 0.0).count();
  if (n_components == 0) return 0;
  const Eigen::VectorXd s = Eigen::JacobiSVD<Eigen::MatrixXd>(g).singularValues();
  return static_cast<int>(n_components - (s.array() > 1e-9).count());
}

template <int Dim>
int expect_self_stresses(const ContactNetwork<Dim>& network, StrainSet strains) {
  ResponseOptions options;
  options.strains = strains;
  const ElasticResponse response = elastic_response(network, options);
  const Indeterminacy found = force_indeterminacy(network, response, strains);
  EXPECT_EQ(found.degree, self_stresses(network, strains));
  EXPECT_EQ(force_indeterminacy(network, response).degree, self_stresses(network, StrainSet::diagonal));
  return found.degree;
}

TEST(Indeterminacy, IsTheNumberOfSelfStressesOfRandomNetworks) {
  int n_isostatic = 0, n_hyperstatic = 0;
  for (unsigned seed = 0; seed < 15; ++seed)
    for (const auto& law :
         {test::elastic_law(1.0, 0.6, 0.1), test::elastic_law(1.0, 0.6, 0.0), test::elastic_law(1.0, 0.0, 0.0)})
      for (const StrainSet strains : {StrainSet::diagonal, StrainSet::full})
        for (const double density : {0.9, 1.4, 2.0}) {
          const int in_2d =
              expect_self_stresses(contact_network(test::random_packing<2>(20, seed, law, density)), strains);
          expect_self_stresses(contact_network(test::random_packing<3>(10, seed, law, density)), strains);
          (in_2d == 0 ? n_isostatic : n_hyperstatic) += 1;
        }
  EXPECT_GT(n_isostatic, 5);
  EXPECT_GT(n_hyperstatic, 5);
}

/// Returns equal grains at the nodes of a square or simple cubic lattice with two of them along each side of the cell.
template <int Dim>
Packing<Dim> two_along_each_side(double spacing, const Law& law) {
  constexpr int kGrains = 1 << Dim;
  Packing<Dim> packing;
  packing.law = law;
  packing.cell.matrix = 2.0 * spacing * Mat<Dim>::Identity();
  packing.grains = Grains<Dim>::with_size(kGrains);
  for (int i = 0; i < kGrains; ++i)
    for (int a = 0; a < Dim; ++a) packing.grains.position[i][a] = spacing * ((i >> a) & 1);
  packing.grains.radius.assign(kGrains, 0.5005 * spacing);
  packing.grains.mass.assign(kGrains, 1.0);
  find_contacts(packing);
  return packing;
}

TEST(Indeterminacy, CountsTheMechanismsOfGrainsThatTurnLikeGears) {
  // All neighbours can turn in opposite directions at no cost. Rounding errors may give these motions a positive
  // stiffness, in some cases and not in others, so that many spacings and stiffnesses are tried.
  RandomStream random(1, 2);
  for (int k = 0; k < 40; ++k) {
    const double spacing = random.uniform(0.3, 3.0), kn = std::pow(10.0, random.uniform(2.0, 5.0));
    const Law law = test::elastic_law(kn, random.uniform() * kn, 0.0);
    expect_self_stresses(contact_network(two_along_each_side<2>(spacing, law)), StrainSet::diagonal);
    expect_self_stresses(contact_network(two_along_each_side<3>(spacing, law)), StrainSet::full);
    expect_self_stresses(contact_network(test::honeycomb(spacing, law)), StrainSet::diagonal);
  }
}

TEST(Indeterminacy, OfAFrictionlessTriangularLatticeCountsItsSpareContacts) {
  // One disk has three contacts with its images, and therefore 3 force components. The disk has 3 motions and the cell
  // has 2 strains; of these 5, the 2 translations and the rotation of the disk need no force.
  const auto network = contact_network(test::triangular(1.0, test::elastic_law(1.0, 0.0, 0.0)));
  const Indeterminacy found = force_indeterminacy(network, elastic_response(network, {}));
  EXPECT_EQ(found.n_components, 3);
  EXPECT_EQ(found.n_unknowns, 5);
  EXPECT_EQ(found.n_null_modes, 3);
  EXPECT_EQ(found.degree, 1);
}

TEST(Indeterminacy, OfNothingIsZero) {
  Packing<2> packing = test::triangular(1.0, test::elastic_law(1.0, 0.0, 0.0));
  packing.contacts.clear();
  const auto network = contact_network(packing);
  EXPECT_EQ(force_indeterminacy(network, elastic_response(network, {})).degree, 0);
}

}  // namespace
}  // namespace floc
