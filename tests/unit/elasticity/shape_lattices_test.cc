#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "floc/base/error.h"
#include "floc/elasticity/moduli.h"
#include "floc/packing/law/named_stiffness.h"
#include "support/rigid_states.h"

/// Compares the moduli of lattices of angular grains with closed forms. Each contact point acts like a spring with the
/// stiffnesses K_N and K_T, without prestress.
namespace floc::test {
namespace {

constexpr double kNormal = 1.0, kTangential = 0.7;

/// Returns a packing of grains with equal shapes. Each contact point between two faces is a spring. Contacts between
/// corners (diagonal neighbours) are removed.
/// @param is_face  function of the vector from one grain to the other; true if the two grains share a face
template <int Dim>
Packing<Dim> face_lattice(const Mat<Dim>& cell, const std::vector<Vec<Dim>>& positions, const Shape<Dim>& shape,
                          double scale, const std::function<bool(const Vec<Dim>&)>& is_face,
                          StiffnessPer per = StiffnessPer::point) {
  Packing<Dim> packing;
  packing.law = rigid_law(0.5);
  packing.cell.matrix = cell;
  packing.grains = Grains<Dim>::with_size(static_cast<int>(positions.size()));
  packing.grains.position = positions;
  set_shape(packing.grains, shape, scale);
  packing.contacts = ContactPoints<Dim>().find(packing, 1e-9);
  std::erase_if(packing.contacts, [&](const Contact<Dim>& c) { return !is_face(branch(packing, c)); });
  return with_named_stiffness(packing, {kNormal, kTangential, per});
}

template <int Dim>
Moduli moduli_of_lattice(const Packing<Dim>& packing) {
  ModuliOptions options;
  options.strains = StrainSet::full;
  options.unloaded = true;
  options.force_tolerance = 0.0;
  return elastic_moduli(contact_network(packing), NetworkLoad<Dim>{.unloaded = true}, options);
}

TEST(ShapeLattices, SquaresFaceToFace) {
  std::vector<Vec<2>> positions;
  for (int k = 0; k < 12; ++k) positions.emplace_back(0.5 + k % 4, 0.5 + k / 4);
  const Packing<2> packing =
      face_lattice<2>(Vec<2>(4.0, 3.0).asDiagonal(), positions, box<2>(Vec<2>(1.0, 1.0), 0.0), std::sqrt(2.0),
                      [](const Vec<2>& r) { return r.norm() < 1.2; });
  ASSERT_EQ(packing.contacts.size(), 48u);
  const Moduli m = moduli_of_lattice(packing);
  EXPECT_NEAR(m.C(0, 0), 2.0 * kNormal, 1e-9);
  EXPECT_NEAR(m.C(1, 1), 2.0 * kNormal, 1e-9);
  EXPECT_NEAR(m.C(0, 1), 0.0, 1e-9);
  EXPECT_NEAR(m.C(2, 2), kTangential, 1e-9);
}

TEST(ShapeLattices, Hexagons) {
  std::vector<Vec<2>> positions;
  const double height = std::sqrt(0.75);
  for (int k = 0; k < 16; ++k) positions.emplace_back(k % 4 + 0.5 * (k / 4 % 2), height * (k / 4));
  // Hexagons with sides of 1/sqrt(3) and centres at a distance of 1. Each hexagon has a corner at its top and
  // at its bottom.
  Packing<2> turned;
  const Shape<2> hexagon = regular_polygon(6, 0.0);
  const auto lattice = [&](double angle) {
    Packing<2> p;
    p.law = rigid_law(0.5);
    p.cell.matrix = Vec<2>(4.0, 4.0 * height).asDiagonal();
    p.grains = Grains<2>::with_size(16);
    p.grains.position = positions;
    set_shape(p.grains, hexagon, 2.0 / std::sqrt(3.0) / hexagon.diameter());
    p.grains.orientation.assign(16, angle);
    p.contacts = ContactPoints<2>().find(p, 1e-9);
    return p;
  };
  turned = lattice(0.0);
  if (turned.contacts.size() != 96u) turned = lattice(std::numbers::pi / 6.0);
  std::erase_if(turned.contacts, [&](const Contact<2>& c) { return branch(turned, c).norm() > 1.1; });
  ASSERT_EQ(turned.contacts.size(), 96u);
  const Moduli m = moduli_of_lattice(with_named_stiffness(turned, {kNormal, kTangential}));
  EXPECT_NEAR(m.B, std::sqrt(3.0) * kNormal, 1e-9);
  EXPECT_NEAR(m.C(2, 2), 0.5 * std::sqrt(3.0) * (kNormal + kTangential), 1e-9);
  EXPECT_NEAR(m.G, 0.5 * std::sqrt(3.0) * (kNormal + kTangential), 1e-9);
}

TEST(ShapeLattices, RunningBond) {
  State<2> state = brick_bond(1.0, 0.5);
  const Moduli m = moduli_of_lattice(with_named_stiffness(state.packing, {kNormal, kTangential}));
  EXPECT_NEAR(m.C(1, 1), 4.0 * kNormal, 1e-9);
  EXPECT_NEAR(m.C(0, 0), 2.0 * kNormal + kTangential, 1e-9);
  EXPECT_NEAR(m.C(2, 2), 1.2923077, 1e-7);
}

TEST(ShapeLattices, Cubes) {
  std::vector<Vec<3>> positions;
  for (int k = 0; k < 27; ++k) positions.emplace_back(0.5 + k % 3, 0.5 + k / 3 % 3, 0.5 + k / 9);
  const Packing<3> packing =
      face_lattice<3>(Vec<3>(3.0, 3.0, 3.0).asDiagonal(), positions, box<3>(Vec<3>(1.0, 1.0, 1.0), 0.0),
                      std::sqrt(3.0), [](const Vec<3>& r) { return r.norm() < 1.2; });
  ASSERT_EQ(packing.contacts.size(), 81u * 4u);
  const Moduli m = moduli_of_lattice(packing);
  for (int a = 0; a < 3; ++a) {
    EXPECT_NEAR(m.C(a, a), 4.0 * kNormal, 1e-9);
    EXPECT_NEAR(m.C(a, (a + 1) % 3), 0.0, 1e-9);
    EXPECT_NEAR(m.C(3 + a, 3 + a), 2.0 * kTangential, 1e-9);
  }
}

/// Faces of squares have two contact points and faces of cubes four, so that a stiffness for each contact is divided by
/// two and by four.
TEST(ShapeLattices, OfStiffnessesPerContact) {
  const auto is_face = [](const auto& r) { return r.norm() < 1.2; };
  std::vector<Vec<2>> positions;
  for (int k = 0; k < 12; ++k) positions.emplace_back(0.5 + k % 4, 0.5 + k / 4);
  const Moduli squares =
      moduli_of_lattice(face_lattice<2>(Vec<2>(4.0, 3.0).asDiagonal(), positions, box<2>(Vec<2>(1.0, 1.0), 0.0),
                                        std::sqrt(2.0), is_face, StiffnessPer::contact));
  EXPECT_NEAR(squares.C(0, 0), kNormal, 1e-9);
  EXPECT_NEAR(squares.C(0, 1), 0.0, 1e-9);
  EXPECT_NEAR(squares.C(2, 2), 0.5 * kTangential, 1e-9);
  std::vector<Vec<3>> centres;
  for (int k = 0; k < 27; ++k) centres.emplace_back(0.5 + k % 3, 0.5 + k / 3 % 3, 0.5 + k / 9);
  const Moduli cubes = moduli_of_lattice(face_lattice<3>(Vec<3>(3.0, 3.0, 3.0).asDiagonal(), centres,
                                                         box<3>(Vec<3>(1.0, 1.0, 1.0), 0.0), std::sqrt(3.0),
                                                         is_face, StiffnessPer::contact));
  EXPECT_NEAR(cubes.C(2, 2), kNormal, 1e-9);
  EXPECT_NEAR(cubes.C(5, 5), 0.5 * kTangential, 1e-9);
}

/// Two periodic images of a grain are two pairs.
TEST(NamedStiffness, PerContactIsDividedAmongThePointsOfAPair) {
  Packing<2> packing;
  packing.law = rigid_law(0.5);
  packing.contacts.resize(7);
  const std::vector<std::array<int, 3>> pairs = {{0, 1, 0}, {0, 1, 0}, {0, 1, 1}, {0, 2, 0},
                                                 {1, 2, 0}, {1, 2, 0}, {1, 2, 0}};
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    packing.contacts[k].i = pairs[k][0];
    packing.contacts[k].j = pairs[k][1];
    packing.contacts[k].image = {pairs[k][2], 0};
  }
  const Packing<2> named = with_named_stiffness(packing, {6.0, 3.0, StiffnessPer::contact});
  std::vector<double> normal, tangential;
  for (const Contact<2>& c : named.contacts) normal.push_back(c.kn), tangential.push_back(c.kt);
  EXPECT_THAT(normal, testing::ElementsAre(3.0, 3.0, 6.0, 6.0, 2.0, 2.0, 2.0));
  EXPECT_THAT(tangential, testing::ElementsAre(1.5, 1.5, 3.0, 3.0, 1.0, 1.0, 1.0));
}

TEST(NamedStiffness, GoesWithRigidContactsAndFriction) {
  const Packing<2> rough = triangular_crystal(1.0, 0.3).packing, smooth = triangular_crystal(1.0, 0.0).packing;
  const Packing<2> named = with_named_stiffness(rough, {2.0, 0.5});
  EXPECT_FALSE(named.law.is_rigid());
  EXPECT_EQ(named.law.friction_coefficient(), 0.3);
  EXPECT_EQ(named.contacts[0].kn, 2.0);
  EXPECT_EQ(named.contacts[0].kt, 0.5);
  EXPECT_THROW(with_named_stiffness(rough, {2.0, 0.0}), InputError);
  EXPECT_THROW(with_named_stiffness(smooth, {2.0, 1.0}), InputError);
  EXPECT_THROW(with_named_stiffness(named, {2.0, 1.0}), InputError);
  EXPECT_THROW(with_named_stiffness(rough, {0.0, 1.0}), InputError);
}

/// Triangular crystal of disks: B = sqrt(3)/2 K_N, G = sqrt(3)/4 (K_N + K_T).
TEST(NamedStiffness, GivesTheModuliOfACrystal) {
  const Packing<2> named = with_named_stiffness(triangular_crystal(1.0, 0.3).packing, {kNormal, kTangential});
  const Moduli m = elastic_moduli(named, {});
  EXPECT_NEAR(m.B, 0.5 * std::sqrt(3.0) * kNormal, 1e-9);
  EXPECT_NEAR(m.G, 0.25 * std::sqrt(3.0) * (kNormal + kTangential), 1e-9);
}

}  // namespace
}  // namespace floc::test
