#include "floc/verification/verify_rigid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "floc/packing/locate.h"
#include "floc/rigid/contact_points.h"
#include "floc/shape/generators.h"
#include "floc/verification/contact_check.h"
#include "floc/verification/rigid_geometry.h"
#include "floc/verification/verify_state.h"
#include "support/rigid_states.h"

namespace floc::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Returns the names of the criteria that a state violates.
template <int Dim>
std::vector<std::string> failed(const State<Dim>& state) {
  std::vector<std::string> names;
  for (const Criterion& c : verify_state(state))
    if (!c.holds) names.emplace_back(c.name);
  return names;
}

template <int Dim>
Criterion criterion(const State<Dim>& state, const std::string& name) {
  for (const Criterion& c : verify_state(state))
    if (name == c.name) return c;
  ADD_FAILURE() << "no criterion " << name;
  return {};
}

template <int Dim>
std::string where(const State<Dim>& state, const std::string& name) {
  return criterion(state, name).where;
}

TEST(VerifyRigid, AcceptsCrystalsUnderPressure) {
  EXPECT_THAT(failed(triangular_crystal(0.7, 0.3)), IsEmpty());
  EXPECT_THAT(failed(triangular_crystal(0.7, 0.0)), IsEmpty());
  EXPECT_THAT(failed(brick_bond(0.7, 0.3)), IsEmpty());
  EXPECT_THAT(failed(cubic_crystal(0.7, 0.3)), IsEmpty());
  for (const char* name : {"geometry", "cone", "force", "moment", "stress", "mean_stress", "boundary_balance"})
    EXPECT_LT(*criterion(brick_bond(0.7, 0.3), name).value, 1e-14) << name;
  EXPECT_EQ(triangular_crystal(0.7, 0.3).packing.contacts.size(), 48u);
  EXPECT_EQ(brick_bond(0.7, 0.3).packing.contacts.size(), 12u * 6u);
}

/// Three disks in a triangle, without contacts to images. They carry no forces, because there is no pressure.
TEST(VerifyRigid, AcceptsThreeDisksThatTouchWithoutForces) {
  State<2> state = triangular_crystal(0.7, 0.3);
  Grains<2>& g = state.packing.grains;
  g = Grains<2>::with_size(3);
  g.radius.assign(3, 0.5);
  g.mass.assign(3, 1.0);
  g.position = {Vec<2>(1.0, 1.0), Vec<2>(2.0, 1.0), Vec<2>(1.5, 1.0 + std::sqrt(0.75))};
  load_contacts(state, 0.0, [](const Contact<2>&) { return 0.0; });
  EXPECT_EQ(state.packing.contacts.size(), 3u);
  EXPECT_THAT(failed(state), IsEmpty());
}

TEST(VerifyRigid, NamesTheGrainOutOfBalance) {
  State<2> state = triangular_crystal(0.7, 0.3);
  Contact<2>& c = state.packing.contacts[5];
  c.normal_force = c.elastic_force *= 1.01;
  measure(state);
  EXPECT_THAT(failed(state), testing::IsSupersetOf({"force", "stress"}));
  EXPECT_THAT(where(state, "force"), HasSubstr("grain " + std::to_string(c.i)));
  State<2> turning = brick_bond(0.7, 0.3);
  // At one of the two contact points of a side, the force is increased; at the other point, it is reduced by the same
  // amount. The net force stays zero, but the net moment does not.
  Contact<2>&one = turning.packing.contacts[0], &other = turning.packing.contacts[1];
  ASSERT_TRUE(one.i == other.i && one.j == other.j && one.image == other.image);
  one.normal_force = one.elastic_force += 0.1;
  other.normal_force = other.elastic_force -= 0.1;
  measure(turning);
  EXPECT_THAT(failed(turning), ElementsAre("moment"));
  EXPECT_THAT(where(turning, "moment"), HasSubstr("grain "));
}

TEST(VerifyRigid, NamesTheGrainThatMoves) {
  State<2> state = triangular_crystal(0.7, 0.3);
  state.packing.grains.velocity[3] = Vec<2>(0.1, 0.0);
  measure(state);
  EXPECT_THAT(failed(state), ElementsAre("energy"));
  EXPECT_THAT(where(state, "energy"), HasSubstr("grain 3 at the velocity 0.1"));
}

TEST(VerifyRigid, RefusesForcesThatDriveTheMotion) {
  State<3> state = cubic_crystal(0.7, 0.3);
  // The cell expands against the pressure: the contact forces then do work on its motion.
  state.packing.cell.velocity = 1e-3 * state.packing.cell.matrix;
  EXPECT_THAT(failed(state), ElementsAre("power", "boundary_motion"));
  state.packing.cell.velocity *= -1.0;
  EXPECT_THAT(failed(state), ElementsAre("boundary_motion"));
}

/// The side of a square touches that of a larger one at one corner or at both, if the gap of the other corner is zero up to
/// rounding. Both types are accepted there, and only the right one elsewhere.
TEST(VerifyRigid, AcceptsBothTypesOfATie) {
  for (const double gap : {-1e-6, 0.0, 1e-6}) {
    SCOPED_TRACE(testing::Message() << "gap of the second corner " << gap);
    Packing<2> squares;
    squares.law = rigid_law(0.3);
    squares.cell.matrix = 5.0 * Mat<2>::Identity();
    squares.grains = Grains<2>::with_size(2);
    set_shape<2>(squares.grains, box<2>(Vec<2>(1.0, 1.0), 0.0), std::sqrt(2.0));
    const double overlap = -1e-3, tilt = gap - overlap, turn = std::asin(tilt);
    squares.grains.scale[0] *= 2.0;
    squares.grains.radius[0] *= 2.0;
    squares.grains.position = {Vec<2>(0.5, 2.0), Vec<2>(2.0, 2.0)};
    squares.grains.orientation = {0.0, turn};
    // The centre of the second square is 1/sqrt(2) from its corners, of which the deeper one overlaps by 1e-3.
    squares.grains.position[1][0] = 1.5 + overlap + 0.5 * (std::cos(turn) + std::sin(turn));
    squares.contacts = ContactPoints<2>().find(squares, -1e-4);
    ASSERT_EQ(squares.contacts.size(), 1U);
    EXPECT_NEAR(squares.contacts[0].gap, overlap, 1e-12);
    for (const ContactType type : {ContactType::kVertexFace, ContactType::kFaceFace}) {
      squares.contacts[0].type = type;
      const bool is_right = (type == ContactType::kFaceFace) == (gap < 0.0), is_tie = gap == 0.0;
      const RigidGeometry<2> geometry = rigid_geometry(squares, 0.0, relative_distance_error(squares));
      EXPECT_EQ(geometry.recorded[0].type == type, is_right || is_tie) << contact_type_name(type);
    }
  }
}

TEST(VerifyRigid, RefusesForcesOutsideTheCone) {
  State<2> sliding = triangular_crystal(0.7, 0.3);
  for (Contact<2>& c : sliding.packing.contacts) {
    c.shear_force = 0.31 * c.normal_force * Vec<2>(-c.normal[1], c.normal[0]);
    c.sliding = true;
  }
  measure(sliding);
  EXPECT_THAT(failed(sliding), testing::Contains("cone"));
  EXPECT_THAT(where(sliding, "cone"), HasSubstr("tangential force"));
  State<2> pulling = triangular_crystal(-0.7, 0.0);
  EXPECT_THAT(failed(pulling), testing::Contains("cone"));
  EXPECT_THAT(where(pulling, "cone"), HasSubstr("a tensile force that exceeds their adhesion"));
}

TEST(VerifyRigid, AcceptsPullsUpToTheAdhesion) {
  State<2> state = triangular_crystal(-0.7, 0.0);
  state.packing.law = rigid_law(0.2, 0.5);
  for (Contact<2>& c : state.packing.contacts) c.elastic_force = c.normal_force + 0.5;
  measure(state);
  EXPECT_THAT(failed(state), IsEmpty());
  state.packing.contacts[0].elastic_force = 0.3;
  EXPECT_THAT(failed(state), ElementsAre("law"));
}

TEST(VerifyRigid, RefusesAForceAcrossAGap) {
  State<2> state = triangular_crystal(0.7, 0.3);
  for (double& r : state.packing.grains.radius) r *= 1.0 - 2e-4;
  for (Contact<2>& c : state.packing.contacts) place(locate(state.packing, c), c);
  measure(state);
  EXPECT_THAT(failed(state), ElementsAre("gap"));
  EXPECT_THAT(where(state, "gap"), HasSubstr("carry a force across the gap"));
}

TEST(VerifyRigid, RefusesOverlapsAndNamesThePair) {
  State<2> state = triangular_crystal(0.7, 0.3);
  for (double& r : state.packing.grains.radius) r *= 1.0 + 2e-4;
  for (Contact<2>& c : state.packing.contacts) place(locate(state.packing, c), c);
  measure(state);
  EXPECT_THAT(failed(state), ElementsAre("gap"));
  state.packing.contacts.erase(state.packing.contacts.begin());
  EXPECT_THAT(failed(state), testing::Contains("list"));
  EXPECT_THAT(where(state, "list"), HasSubstr("grains 0-1 are missing"));
}

TEST(VerifyRigid, RefusesAListOutOfOrder) {
  State<2> state = brick_bond(0.7, 0.3);
  std::swap(state.packing.contacts[2], state.packing.contacts[3]);
  EXPECT_THAT(failed(state), ElementsAre("list"));
}

TEST(VerifyRigid, RefusesAnotherGeometry) {
  const State<2> state = brick_bond(0.7, 0.3);
  State<2> other = state;
  other.packing.contacts[3].gap += 1e-6;
  EXPECT_THAT(failed(other), ElementsAre("geometry"));
  other = state;
  other.packing.contacts[3].arm_i[0] += 1e-6;
  EXPECT_THAT(failed(other), testing::Contains("geometry"));
  other = state;
  other.packing.contacts[3].type = ContactType::kVertexFace;
  EXPECT_THAT(failed(other), ElementsAre("geometry"));
  EXPECT_THAT(where(other, "geometry"), HasSubstr("vertex-face instead of face-face"));
  other = state;
  other.packing.grains.orientation[4] += 1e-3;
  EXPECT_THAT(failed(other), testing::Contains("geometry"));
}

TEST(VerifyRigid, RefusesStiffnesses) {
  State<2> state = triangular_crystal(0.7, 0.3);
  state.packing.contacts[0].kn = 1.0;
  EXPECT_THAT(failed(state), ElementsAre("law"));
  EXPECT_THAT(where(state, "law"), HasSubstr("the stiffness 1"));
}

TEST(VerifyRigid, RefusesAnotherRecord) {
  State<2> state = triangular_crystal(0.7, 0.3);
  state.stress(0, 0) *= 1.01;
  EXPECT_THAT(failed(state), ElementsAre("mean_stress"));
  state = triangular_crystal(0.7, 0.3);
  state.residuals.force = 1e-3;
  EXPECT_THAT(failed(state), ElementsAre("recorded"));
  state = triangular_crystal(0.7, 0.3);
  state.target_stress *= 1.01;
  EXPECT_THAT(failed(state), testing::Contains("stress"));
  state = triangular_crystal(0.7, 0.3);
  state.target_side[0] = 4.1;
  EXPECT_THAT(failed(state), ElementsAre("length"));
}

TEST(VerifyRigid, AcceptsWhatWasRecordedWithinTheMarginsOfTheSearch) {
  // If two squares touch along a side, either square can provide the reference face. Recorded contacts must be accepted
  // in both cases.
  const State<2> state = brick_bond(0.7, 0.3);
  ContactPoints<2> points;
  State<2> turned = state;
  for (double& angle : turned.packing.grains.orientation) angle += std::numbers::pi / 2.0;
  turned.packing.contacts = points.find(turned.packing, 1e-9);
  ASSERT_EQ(turned.packing.contacts.size(), state.packing.contacts.size());
  for (Contact<2>& c : turned.packing.contacts)
    c.normal_force = c.elastic_force = 0.7 * (std::abs(c.normal[0]) > 0.5 ? 0.5 : 0.25);
  measure(turned);
  EXPECT_THAT(failed(turned), IsEmpty());
}

}  // namespace
}  // namespace floc::test
