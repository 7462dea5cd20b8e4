#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "floc/elasticity/moduli.h"
#include "support/law_units.h"
#include "support/network_packings.h"

namespace floc {
namespace {

template <int Dim>
Moduli full_moduli(const Packing<Dim>& packing) {
  ModuliOptions options;
  options.strains = StrainSet::full;
  return elastic_moduli(packing, options);
}

/// Relative tolerance. Changes of the packing change the order of sums and the rounding of branch vectors. A condition
/// number of about 1e3 amplifies both errors. Long branch vectors need a larger tolerance.
constexpr double kSame = 1e-10;

template <int Dim>
class Invariance : public ::testing::Test {
 protected:
  /// @param unit  unit of stress in the changed packing
  void expect_same_moduli(Packing<Dim> changed, double unit = 1.0) const {
    find_contacts(changed);
    ASSERT_EQ(changed.contacts.size(), packing_.contacts.size());
    const Eigen::MatrixXd difference = full_moduli(changed).C / unit - reference_;
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), kSame * reference_.cwiseAbs().maxCoeff());
  }

  void shuffle() {
    std::vector<int> order(packing_.grains.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), std::mt19937(3));
    Packing<Dim> changed = packing_;
    for (int i = 0; i < packing_.grains.size(); ++i) {
      changed.grains.position[i] = packing_.grains.position[order[i]];
      changed.grains.radius[i] = packing_.grains.radius[order[i]];
    }
    expect_same_moduli(changed);
  }

  void translate() {
    Packing<Dim> changed = packing_;
    const Vec<Dim> away = Vec<Dim>::LinSpaced(1.234, -2.7);
    for (Vec<Dim>& x : changed.grains.position) x = changed.cell.wrapped(x + away);
    expect_same_moduli(changed);
  }

  void choose_other_lattice_vectors() {
    Packing<Dim> changed = packing_;
    changed.cell.matrix.row(1) += 2.0 * changed.cell.matrix.row(0);
    changed.cell.matrix.row(0) *= -1.0;
    if (Dim == 3) changed.cell.matrix.row(Dim - 1) -= changed.cell.matrix.row(1);
    for (Vec<Dim>& x : changed.grains.position) x = changed.cell.wrapped(x);
    expect_same_moduli(changed);
  }

  void change_units() {
    constexpr double kLength = 1.7e-6, kForce = 3.1e-9;
    Packing<Dim> changed = packing_;
    changed.cell.matrix *= kLength;
    for (Vec<Dim>& x : changed.grains.position) x *= kLength;
    for (double& radius : changed.grains.radius) radius *= kLength;
    changed.law = test::in_units(changed.law, kLength, kForce);
    expect_same_moduli(changed, kForce / std::pow(kLength, Dim - 1));
  }

  Packing<Dim> packing_ = test::random_packing<Dim>(40, 11, test::elastic_law(1.0, 0.6, 0.05), 2.5);
  Eigen::MatrixXd reference_ = full_moduli(packing_).C;
};

using Invariance2 = Invariance<2>;
using Invariance3 = Invariance<3>;

TEST_F(Invariance2, ModuliDoNotSeeTheOrderOfTheGrains) {
  shuffle();
}
TEST_F(Invariance3, ModuliDoNotSeeTheOrderOfTheGrains) {
  shuffle();
}
TEST_F(Invariance2, ModuliDoNotSeeWhereTheCellIsCut) {
  translate();
}
TEST_F(Invariance3, ModuliDoNotSeeWhereTheCellIsCut) {
  translate();
}
TEST_F(Invariance2, ModuliDoNotSeeTheChoiceOfLatticeVectors) {
  choose_other_lattice_vectors();
}
TEST_F(Invariance3, ModuliDoNotSeeTheChoiceOfLatticeVectors) {
  choose_other_lattice_vectors();
}
TEST_F(Invariance2, ModuliDoNotSeeTheChoiceOfUnits) {
  change_units();
}
TEST_F(Invariance3, ModuliDoNotSeeTheChoiceOfUnits) {
  change_units();
}

TEST_F(Invariance2, ModuliOfADoubledCellAreTheSame) {
  Packing<2> changed = packing_;
  changed.cell.matrix.row(0) *= 2.0;
  for (int i = 0; i < packing_.grains.size(); ++i) {
    changed.grains.position.push_back(packing_.grains.position[i] + packing_.cell.matrix.row(0).transpose());
    changed.grains.radius.push_back(packing_.grains.radius[i]);
  }
  changed.grains.mass.resize(80, 1.0);
  find_contacts(changed);
  EXPECT_EQ(changed.contacts.size(), 2 * packing_.contacts.size());
  EXPECT_LT((full_moduli(changed).C - reference_).cwiseAbs().maxCoeff(), 1e-11);
}

}  // namespace
}  // namespace floc
