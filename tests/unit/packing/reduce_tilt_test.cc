#include "floc/packing/reduce_tilt.h"

#include <gtest/gtest.h>

#include <tuple>

#include "floc/packing/balance.h"
#include "floc/packing/law/contact_forces.h"
#include "support/network_packings.h"
#include "support/springs.h"

namespace floc {
namespace {

/// Returns a random packing in a skewed cell. Its springs carry forces. The packing is so small that grains touch their
/// own images.
/// @param offset  component of the last lattice vector along the first one, divided by the length of the first lattice
/// vector
template <int Dim>
Packing<Dim> slanted_packing(double offset) {
  Packing<Dim> packing = test::random_packing<Dim>(Dim == 2 ? 7 : 5, 3, test::elastic_law(1.0, 0.7, 0.01));
  packing.cell.matrix = Mat<Dim>(packing.cell.matrix.template triangularView<Eigen::Lower>());
  packing.cell.matrix(Dim - 1, 0) = offset * packing.cell.matrix(0, 0);
  for (Vec<Dim>& x : packing.grains.position) x = packing.cell.wrapped(x);
  packing.contacts.clear();
  find_contacts(packing);
  test::stretch_at_random(packing);
  refresh_contacts(packing);
  return packing;
}

template <class T>
class ReduceTilt : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(ReduceTilt, Dimensions);

TYPED_TEST(ReduceTilt, KeepsTheContactsTheForcesAndTheStress) {
  constexpr int kDim = TypeParam::value;
  const Packing<kDim> slanted = slanted_packing<kDim>(2.3);
  Packing<kDim> reduced = slanted;
  reduce_tilt(reduced, kDim - 1);
  EXPECT_NEAR(reduced.cell.matrix(kDim - 1, 0) / reduced.cell.matrix(0, 0), 0.3, 1e-14);
  EXPECT_NEAR(reduced.cell.volume() / slanted.cell.volume(), 1.0, 1e-14);
  for (const Vec<kDim>& x : reduced.grains.position) {
    const Vec<kDim> s = reduced.cell.reduced(x);
    EXPECT_GT(s.minCoeff(), -1e-14);
    EXPECT_LT(s.maxCoeff(), 1.0 + 1e-14);
  }
  Packing<kDim> found = reduced;
  found.contacts.clear();
  find_contacts(found);
  ASSERT_EQ(reduced.contacts.size(), slanted.contacts.size());
  ASSERT_EQ(reduced.contacts.size(), found.contacts.size());
  for (std::size_t k = 0; k < found.contacts.size(); ++k) {
    const Contact<kDim>&p = reduced.contacts[k], &q = found.contacts[k];
    EXPECT_EQ(std::tie(p.i, p.j, p.image), std::tie(q.i, q.j, q.image));
    EXPECT_NEAR(p.gap, q.gap, 1e-13);
  }
  const Mat<kDim> difference = static_stress(reduced) - static_stress(slanted);
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-13 * static_stress(slanted).norm());
  const Balance<kDim> before = net_forces(slanted), after = net_forces(reduced);
  for (std::size_t i = 0; i < before.force.size(); ++i) {
    EXPECT_LT((before.force[i] - after.force[i]).norm(), 1e-12) << i;
    EXPECT_LT((before.moment[i] - after.moment[i]).norm(), 1e-12) << i;
  }
}

TYPED_TEST(ReduceTilt, LeavesWhatIsSlantedByHalfOrLess) {
  constexpr int kDim = TypeParam::value;
  for (const double offset : {0.0, 0.4, -0.4, 0.5}) {
    Packing<kDim> packing = slanted_packing<kDim>(offset);
    const Mat<kDim> lattice = packing.cell.matrix;
    reduce_tilt(packing, kDim - 1);
    EXPECT_EQ(packing.cell.matrix, lattice) << offset;
  }
  Packing<kDim> back = slanted_packing<kDim>(-0.7);
  reduce_tilt(back, kDim - 1);
  EXPECT_NEAR(back.cell.matrix(kDim - 1, 0) / back.cell.matrix(0, 0), 0.3, 1e-14);
}

}  // namespace
}  // namespace floc
