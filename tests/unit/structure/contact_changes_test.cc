#include "floc/structure/contact_changes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "floc/packing/law/contact_forces.h"
#include "floc/structure/rigid_clusters.h"
#include "support/contact_laws.h"
#include "support/lattices.h"

namespace floc::test {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

/// Returns touching disks in rows and columns of a square lattice. There is empty space around them, so that no
/// disks touch across the sides of the cell.
Packing<2> block(int columns, int rows) {
  std::vector<Vec<2>> places;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) places.emplace_back(x + 1.0, y + 1.0);
  return disks(12.0 * Mat<2>::Identity(), places, 1.0, elastic_law(1.0, 0.5, 0.1));
}

/// Returns the packing with all grains shifted and moved back into the cell.
Packing<2> translated(Packing<2> packing, const Vec<2>& by) {
  for (Vec<2>& x : packing.grains.position) x = packing.cell.wrapped(x + by);
  find_contacts(packing);
  return packing;
}

Packing<2> turned(Packing<2> packing, const std::vector<int>& grains, double angle) {
  const Eigen::Rotation2Dd turn(angle);
  for (const int i : grains) {
    packing.grains.position[i] = turn * packing.grains.position[i];
    packing.grains.orientation[i] += angle;
  }
  find_contacts(packing);
  return packing;
}

TEST(ContactChanges, OfATranslationAcrossTheCellAreNone) {
  const Packing<2> before = random_packing<2>(40, 2, elastic_law(1.0, 0.0, 0.0));
  for (const Vec<2>& by : {Vec<2>(0.3, -0.2), Vec<2>(2.4, 2.6), Vec<2>(-17.0, 100.0)}) {
    const ContactChanges<2> found = contact_changes(before, translated(before, by));
    EXPECT_EQ(found.kept.size(), before.contacts.size());
    EXPECT_THAT(found.lost, IsEmpty());
    EXPECT_THAT(found.gained, IsEmpty());
    EXPECT_LT(found.largest_displacement(), 1e-12);
    EXPECT_LT((found.deformation - Mat<2>::Identity()).norm(), 1e-13);
  }
}

TEST(ContactChanges, OfAnAffineStrainLeaveNoDisplacement) {
  const Packing<3> before = random_packing<3>(60, 2, elastic_law(1.0, 0.0, 0.0));
  Mat<3> F = Mat<3>::Identity();
  F(0, 0) = 0.97, F(1, 1) = 0.99, F(0, 1) = 0.01;
  Packing<3> after = before;
  after.cell.matrix = before.cell.matrix * F.transpose();
  for (Vec<3>& x : after.grains.position) x = F * x;
  for (Contact<3>& c : after.contacts) refresh_contact(after, c);
  const ContactChanges<3> found = contact_changes(before, after);
  EXPECT_LT((found.deformation - F).norm(), 1e-12);
  EXPECT_LT(found.largest_displacement(), 1e-12);
}

TEST(ContactChanges, NameWhatWasLostAndGained) {
  // The third grain leaves the chain of three and ends in contact with the first.
  Packing<2> before =
      disks(8.0 * Mat<2>::Identity(), {{1, 1}, {2, 1}, {3, 1}}, 1.0, elastic_law(1.0, 0.0, 0.0));
  Packing<2> after = before;
  after.grains.position[2] = {1, 2};
  find_contacts(after);
  const ContactChanges<2> found = contact_changes(before, after);
  ASSERT_THAT(found.kept, SizeIs(1));
  ASSERT_THAT(found.lost, SizeIs(1));
  ASSERT_THAT(found.gained, SizeIs(1));
  EXPECT_EQ(before.contacts[found.kept[0].before].j, 1);
  EXPECT_EQ(before.contacts[found.lost[0]].i, 1);
  EXPECT_EQ(after.contacts[found.gained[0]].i, 0);
  EXPECT_EQ(after.contacts[found.gained[0]].j, 2);
  // Only the last of the three grains moved, by the vector (-2, 1). Relative to the mean displacement, this grain moved
  // by 2/3 of the vector, and the two others by -1/3 of the vector.
  EXPECT_LT((found.displacement[2] - 2.0 / 3.0 * Vec<2>(-2, 1)).norm(), 1e-13);
  EXPECT_LT((found.displacement[0] + 1.0 / 3.0 * Vec<2>(-2, 1)).norm(), 1e-13);
  EXPECT_NEAR(found.rms_displacement(), std::sqrt(5.0 * (4.0 + 1.0 + 1.0) / 9.0 / 3.0), 1e-13);
}

TEST(ContactChanges, TellContactsOfOnePairThroughDifferentSidesApart) {
  // Two disks in a narrow cell touch on both sides, directly and through the periodic boundary. In the second state
  // they touch on one side only.
  Mat<2> cell;
  cell << 2.0, 0.0, 0.0, 5.0;
  const Packing<2> before = disks(cell, {{0.1, 1}, {1.1, 1}}, 1.0, elastic_law(1.0, 0.0, 0.0));
  ASSERT_THAT(before.contacts, SizeIs(2));
  Packing<2> after = before;
  after.grains.position[1][0] -= 0.02;
  after.grains.position = {after.cell.wrapped(after.grains.position[0] - Vec<2>(0.5, 0)),
                           after.cell.wrapped(after.grains.position[1] - Vec<2>(0.5, 0))};
  find_contacts(after);
  const ContactChanges<2> found = contact_changes(before, after);
  EXPECT_THAT(found.kept, SizeIs(1));
  EXPECT_THAT(found.gained, IsEmpty());
  ASSERT_THAT(found.lost, SizeIs(1));
  EXPECT_NE(before.contacts[found.lost[0]].image[0], 0);
}

TEST(ContactChanges, CountContactsThatBecameAttractionsAsLost) {
  Packing<2> before = block(3, 1);
  before.law += test::tail_adhesion(1.0, 0.2);
  find_contacts(before);
  Packing<2> after = before;
  after.grains.position[2][0] += 0.1;
  find_contacts(after);
  const ContactChanges<2> found = contact_changes(before, after);
  EXPECT_THAT(found.kept, SizeIs(1));
  EXPECT_THAT(found.lost, SizeIs(1));
  EXPECT_EQ(found.n_parted, 1);
  EXPECT_THAT(contact_changes(after, before).gained, SizeIs(1));
  EXPECT_EQ(contact_changes(after, before).n_parted, 0);
}

TEST(ContactChanges, SeeThroughAnotherChoiceOfLatticeVectors) {
  const Packing<2> before = random_packing<2>(40, 2, elastic_law(1.0, 0.0, 0.0));
  Packing<2> after = before;
  after.cell.matrix.row(1) += 2.0 * after.cell.matrix.row(0);
  after.cell.matrix.row(0) *= -1.0;
  after = translated(after, {0.4, 0.1});
  const ContactChanges<2> found = contact_changes(before, after);
  EXPECT_EQ(found.kept.size(), before.contacts.size());
  EXPECT_THAT(found.lost, IsEmpty());
  EXPECT_LT(found.largest_displacement(), 1e-12);
}

TEST(ContactChanges, AreRefusedBetweenDifferentGrains) {
  const Packing<2> before = block(3, 2);
  EXPECT_THAT(incomparable(before, block(2, 2)),
              HasSubstr("there are 6 grains in one state, but 4 in the other"));
  Packing<2> after = before;
  after.grains.radius[4] *= 1.001;
  EXPECT_THAT(incomparable(before, after),
              HasSubstr("grain 4 has radius 0.51 in one state, but 0.51051 in the other"));
  after = before;
  after.cell.matrix *= 3.0;
  EXPECT_THAT(incomparable(before, after), HasSubstr("lattice"));
  EXPECT_EQ(incomparable(before, before), "");
}

TEST(RigidClusters, AreWhatTurnsAsOne) {
  // Two separate blocks of four grains. One block rotates as a whole. In the other block, one grain rolls on its
  // neighbours.
  Packing<2> before =
      disks(12.0 * Mat<2>::Identity(), {{1, 1}, {2, 1}, {1, 2}, {2, 2}, {6, 6}, {7, 6}, {6, 7}, {7, 7}}, 1.0,
            elastic_law(1.0, 0.5, 0.1));
  Packing<2> after = turned(before, {0, 1, 2, 3}, 0.3);
  const RigidClusters whole = rigid_clusters(before, after, contact_changes(before, after), 1e-6);
  EXPECT_THAT(whole.size, ElementsAre(4, 4));
  EXPECT_EQ(whole.n_stuck, 8);
  EXPECT_EQ(whole.n_clustered(), 8);
  after.grains.orientation[7] += 0.1;
  const RigidClusters rolled = rigid_clusters(before, after, contact_changes(before, after), 1e-6);
  EXPECT_THAT(rolled.size, ElementsAre(4, 3));
  EXPECT_EQ(rolled.cluster[7], -1);
  EXPECT_EQ(rolled.n_stuck, 6);
  EXPECT_THAT(rigid_clusters(before, after, contact_changes(before, after), 0.2).size, ElementsAre(4, 4));
}

TEST(RigidClusters, EndWhereAContactSlides) {
  const Packing<2> before = block(4, 1);
  Packing<2> after = before;
  // Grains 2 and 3 move up by 0.05 a without rotation, so the contact between grains 1 and 2 slides.
  for (const int i : {2, 3}) after.grains.position[i] += Vec<2>(-0.00125, 0.05);
  find_contacts(after);
  const ContactChanges<2> changes = contact_changes(before, after);
  ASSERT_THAT(changes.kept, SizeIs(3));
  EXPECT_THAT(rigid_clusters(before, after, changes, 1e-2).size, ElementsAre(2, 2));
  EXPECT_THAT(rigid_clusters(before, after, changes, 0.1).size, ElementsAre(4));
}

}  // namespace
}  // namespace floc::test
