#include "floc/elasticity/indeterminacy.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

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
