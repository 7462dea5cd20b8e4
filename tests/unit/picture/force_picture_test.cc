#include "floc/picture/force_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "floc/base/error.h"
#include "floc/elasticity/moduli.h"
#include "floc/packing/law/contact_forces.h"
#include "floc/packing/tile.h"
#include "support/contact_laws.h"
#include "support/lattices.h"
#include "support/rigid_states.h"

namespace floc {
namespace {

using test::elastic_law;

/// Three disks with four contacts: compression, tension across the cell boundary, an attraction at a distance,
/// and a force of zero.
Packing<2> four_contacts() {
  Packing<2> packing;
  packing.law = elastic_law(100.0, 50.0, 0.0);
  packing.law += test::tail_adhesion(2.0, 0.1);
  packing.cell.matrix *= 4.0;
  packing.grains = Grains<2>::with_size(3);
  packing.grains.position = {{0.5, 0.5}, {1.5, 0.5}, {3.5, 0.5}};
  packing.grains.radius.assign(3, 0.5);
  const auto contact = [](int i, int j, double normal, double shear) {
    Contact<2> c;
    c.i = i;
    c.j = j;
    c.normal_force = normal;
    c.shear_force = {0.0, shear};
    return c;
  };
  packing.contacts = {contact(0, 1, 6.0, 8.0), contact(0, 2, -3.0, 0.0), contact(1, 2, -1.0, 0.0),
                      contact(1, 2, 1e-9, 0.0)};
  packing.contacts[1].image = {-1, 0};
  packing.contacts[2].distant = true;
  return packing;
}

TEST(EquilibriumForces, LinesJoinCentresAcrossTheBorder) {
  const PackingPicture<2> picture = equilibrium_forces(four_contacts(), 1e-6);
  ASSERT_EQ(picture.lines.size(), 4u);
  EXPECT_EQ(picture.lines[1].from, Vec<2>(0.5, 0.5));
  EXPECT_EQ(picture.lines[1].to, Vec<2>(-0.5, 0.5));
}

TEST(EquilibriumForces, KindsGoBySignAndSizesHoldBothComponents) {
  const PackingPicture<2> picture = equilibrium_forces(four_contacts(), 1e-6);
  EXPECT_EQ(picture.lines[0].kind, LineKind::compression);
  EXPECT_EQ(picture.lines[1].kind, LineKind::tension);
  EXPECT_EQ(picture.lines[2].kind, LineKind::distant);
  EXPECT_EQ(picture.lines[3].kind, LineKind::zero);
  // Forces are in units of the pull-off force, 2.
  EXPECT_DOUBLE_EQ(picture.lines[0].force, 5.0);
  EXPECT_DOUBLE_EQ(picture.lines[1].force, 1.5);
  EXPECT_EQ(picture.force_unit, "F₀");
}

TEST(EquilibriumForces, WithoutAdhesionAreMeasuredInTheirMean) {
  Packing<2> packing = four_contacts();
  packing.law += test::without("adhesion");
  packing.contacts.resize(1);
  const PackingPicture<2> picture = equilibrium_forces(packing, 1e-6);
  EXPECT_DOUBLE_EQ(picture.lines[0].force, 10.0 / 6.0);
  EXPECT_EQ(picture.force_unit, "⟨F⟩");
}

TEST(PressurePhases, BondsWithinThemAreDrawnAndTheLargestPartsAreDark) {
  // Square lattice of six columns and four rows with forces along the rows. Rows 0 and 1 are under pressure,
  // row 2 is under tension. In row 3 two neighbours are under tension; the other grains have no forces.
  Law law = elastic_law(100.0, 50.0, 0.0);
  law += test::constant_adhesion(2.0);
  Packing<2> packing = tiled<2>(test::square_frames(2, 1.0, law), {6, 4});
  const auto row = [&](int i) { return static_cast<int>(std::lround(packing.grains.position[i][1])); };
  const auto column = [&](int i) { return static_cast<int>(std::lround(packing.grains.position[i][0])); };
  for (Contact<2>& c : packing.contacts) {
    const bool lone = row(c.i) == 3 && row(c.j) == 3 && (column(c.i) == 2 && column(c.j) == 3);
    const bool along = std::abs(c.normal[0]) > 0.5;
    c.normal_force = !along ? 0.0 : row(c.i) < 2 ? 1.0 : row(c.i) == 2 || lone ? -1.0 : 0.0;
  }
  const PackingPicture<2> picture = pressure_phases_of(packing, 1e-6);
  int n[2] = {};
  for (const ContactLine<2>& line : picture.lines) {
    EXPECT_TRUE(line.kind == LineKind::compression || line.kind == LineKind::tension);
    ++n[line.kind == LineKind::tension];
  }
  // Compression: two rows, and the bonds between these rows. Tension: one row, the bond between the two grains in the
  // row above, and the two bonds between these grains and the row.
  EXPECT_EQ(n[0], 12 + 6);
  EXPECT_EQ(n[1], 6 + 1 + 2);
  for (int i = 0; i < packing.grains.size(); ++i) {
    const bool pulled = row(i) == 2 || (row(i) == 3 && (column(i) == 2 || column(i) == 3));
    EXPECT_DOUBLE_EQ(picture.shade.value[i], row(i) < 2 ? 1.0 : pulled ? -1.0 : 0.0) << i;
  }
  EXPECT_EQ(picture.force_unit, "F₀");
  EXPECT_DOUBLE_EQ(picture.lines.front().force, 0.5);
}

TEST(IncrementForces, OfASquareLatticeAreTheStressTimesTheSpacing) {
  const Packing<2> packing = test::square_frames(2, 1.0, elastic_law(2.0, 0.6, 0.1));
  const ModuliOptions options;
  const ContactNetwork<2> network = options.loaded_network(packing);
  const Moduli moduli = elastic_moduli(packing, options);
  const auto step = [&](StressStep which) {
    return increment_forces(packing, network, *step_response(network, moduli.response, which));
  };
  const PackingPicture<2> isotropic = step(StressStep::isotropic);
  ASSERT_EQ(isotropic.lines.size(), 2u);
  for (const ContactLine<2>& line : isotropic.lines) {
    EXPECT_EQ(line.kind, LineKind::compression);
    // A unit stress on a unit length exerts a unit force, which is divided by the diameter of 1.02.
    EXPECT_NEAR(line.force, 1.0 / 1.02, 1e-12);
  }
  const PackingPicture<2> deviatoric = step(StressStep::deviatoric);
  EXPECT_NE(deviatoric.lines[0].kind, deviatoric.lines[1].kind);
}

TEST(IncrementForces, OfACubicLatticeAreTheStressTimesTheFace) {
  // A sphere that touches its own images across the six faces of its cell of side 0.98.
  Packing<3> packing;
  packing.law = elastic_law(2.0, 0.6, 0.1);
  packing.cell.matrix *= 0.98;
  packing.grains = Grains<3>::with_size(1);
  packing.grains.radius = {0.5};
  packing.grains.mass = {1.0};
  for (int axis = 2; axis >= 0; --axis) packing.contacts.emplace_back().image[axis] = 1;
  refresh_contacts(packing);
  const ModuliOptions options;
  const ContactNetwork<3> network = options.loaded_network(packing);
  const Moduli moduli = elastic_moduli(packing, options);
  const PackingPicture<3> picture =
      increment_forces(packing, network, *step_response(network, moduli.response, StressStep::isotropic));
  ASSERT_EQ(picture.lines.size(), 3u);
  EXPECT_EQ(picture.force_unit, "a² δP");
  for (const ContactLine<3>& line : picture.lines) {
    EXPECT_EQ(line.kind, LineKind::compression);
    EXPECT_NEAR(line.force, 0.98 * 0.98, 1e-12);
  }
}

/// In a brick pattern, each pair of neighbours touches along sides, at two contact points. If one of the two points has
/// no force, the pair is drawn as touching at a vertex.
TEST(ContactKindsOf, ColoursGoByCarryingPoints) {
  Packing<2> packing = test::brick_bond(1.0, 0.3).packing;
  PackingPicture<2> picture = contact_kinds_of(packing, 1e-6);
  ASSERT_EQ(picture.lines.size(), 72u);
  for (const ContactLine<2>& line : picture.lines) EXPECT_EQ(line.kind, LineKind::tension);
  EXPECT_EQ(picture.tension_name, "two sides");
  packing.contacts[0].normal_force = packing.contacts[0].elastic_force = 0.0;
  picture = contact_kinds_of(packing, 1e-6);
  ASSERT_EQ(picture.lines.size(), 71u);
  EXPECT_EQ(std::ranges::count(picture.lines, LineKind::compression, &ContactLine<2>::kind), 1);
  EXPECT_THROW(contact_kinds_of(test::triangular_crystal(1.0, 0.3).packing, 1e-6), InputError);
}

}  // namespace
}  // namespace floc
