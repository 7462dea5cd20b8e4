#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "floc/elasticity/moduli.h"
#include "support/network_packings.h"

namespace floc {
namespace {

Eigen::MatrixXd full_matrix(const Packing<2>& packing) {
  ModuliOptions options;
  options.strains = StrainSet::full;
  return elastic_moduli(packing, options).C;
}

class Invariance : public ::testing::Test {
 protected:
  void expect_same_moduli(Packing<2> changed) const {
    find_contacts(changed);
    ASSERT_EQ(changed.contacts.size(), packing_.contacts.size());
    // Another order of the same sums: rounding times a condition number of some 1e3.
    EXPECT_LT((full_matrix(changed) - reference_).cwiseAbs().maxCoeff(), 1e-11);
  }
  Packing<2> packing_ = test::random_packing<2>(40, 11, test::elastic_law(1.0, 0.6, 0.05), 2.5);
  Eigen::MatrixXd reference_ = full_matrix(packing_);
};

TEST_F(Invariance, ModuliDoNotSeeTheOrderOfTheGrains) {
  std::vector<int> order(packing_.grains.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  Packing<2> changed = packing_;
  for (int i = 0; i < packing_.grains.size(); ++i) {
    changed.grains.position[i] = packing_.grains.position[order[i]];
    changed.grains.radius[i] = packing_.grains.radius[order[i]];
  }
  expect_same_moduli(changed);
}

TEST_F(Invariance, ModuliDoNotSeeWhereTheCellIsCut) {
  Packing<2> changed = packing_;
  for (Vec<2>& x : changed.grains.position) x = changed.cell.wrapped(x + Vec<2>(1.234, -2.7));
  expect_same_moduli(changed);
}

TEST_F(Invariance, ModuliDoNotSeeTheChoiceOfLatticeVectors) {
  Packing<2> changed = packing_;
  changed.cell.matrix.row(1) += 2.0 * changed.cell.matrix.row(0);
  changed.cell.matrix.row(0) *= -1.0;
  for (Vec<2>& x : changed.grains.position) x = changed.cell.wrapped(x);
  expect_same_moduli(changed);
}

TEST_F(Invariance, ModuliOfADoubledCellAreTheSame) {
  Packing<2> changed = packing_;
  changed.cell.matrix.row(0) *= 2.0;
  for (int i = 0; i < packing_.grains.size(); ++i) {
    changed.grains.position.push_back(packing_.grains.position[i] + packing_.cell.matrix.row(0).transpose());
    changed.grains.radius.push_back(packing_.grains.radius[i]);
  }
  changed.grains.mass.resize(80, 1.0);
  find_contacts(changed);
  EXPECT_EQ(changed.contacts.size(), 2 * packing_.contacts.size());
  EXPECT_LT((full_matrix(changed) - reference_).cwiseAbs().maxCoeff(), 1e-11);
}

}  // namespace
}  // namespace floc
