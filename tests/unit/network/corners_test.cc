#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <vector>

#include "floc/network/free_motions.h"
#include "floc/network/geometric_springs.h"
#include "floc/network/stiffness_matrix.h"
#include "floc/packing/rotation.h"
#include "support/angular_packing.h"
#include "support/rigid_states.h"

/// Networks of grains with corners. The normal forces of such grains have moments, and the number and type of the
/// contact points depend on the features that meet.
namespace floc::test {
namespace {

template <int Dim>
Ends<Dim> periodic() {
  Ends<Dim> ends;
  ends.fill("p");
  return ends;
}

/// Returns the network of springs in the contact points with gaps below 0.1.
template <int Dim>
ContactNetwork<Dim> network_of(Packing<Dim> packing, double kt, double kr) {
  packing.contacts = ContactPoints<Dim>().find(packing, 0.1);
  ContactNetwork<Dim> network = contact_network(packing);
  for (NetworkContact<Dim>& c : network.contacts)
    c.kn = 1.0, c.kt = kt, c.kr = kr, c.ktw = kr, c.distant = false;
  return network;
}

template <int Dim>
Eigen::MatrixXd dense_stiffness(const ContactNetwork<Dim>& network) {
  const int n = network.n_unknowns();
  return Eigen::MatrixXd(stiffness_matrix(network, {}).whole()).topLeftCorner(n, n);
}

Eigen::Index n_zero_eigenvalues(const Eigen::MatrixXd& k) {
  if (k.size() == 0) return 0;
  return (Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues().array() < 1e-12).count();
}

/// Expects that the free motions of a network cost no energy and are independent. Also expects that for each free
/// motion, the stiffness matrix of the unknowns that are solved for has one zero eigenvalue less than the whole matrix.
template <int Dim>
void expect_free_motions_cost_nothing(const ContactNetwork<Dim>& network) {
  const FreeMotions free = find_free_motions(network);
  const Eigen::MatrixXd k = dense_stiffness(network), modes = free.modes;
  EXPECT_LE((k * modes).cwiseAbs().maxCoeff(), 1e-5);
  EXPECT_EQ(Eigen::FullPivLU<Eigen::MatrixXd>(modes).rank(), modes.cols());
  std::vector<int> kept;
  for (int u = 0; u < network.n_unknowns(); ++u)
    if (free.kept[u]) kept.push_back(u);
  const Eigen::MatrixXd solved = dense_stiffness(without_grains(network, free.dead_end))(kept, kept);
  EXPECT_EQ(n_zero_eigenvalues(k) - n_zero_eigenvalues(solved), modes.cols());
}

template <int Dim>
void sweep_stiffnesses() {
  const std::vector<std::vector<Shape<Dim>>> kinds = {rounded_shapes<Dim>(),
                                                      {round_shape<Dim>(0.5)},
                                                      {capsule_shape<Dim>(0.2, 0.4)},
                                                      cut_shapes<Dim>({}, 3, 0.0, 7)};
  for (std::size_t shapes = 0; shapes < kinds.size(); ++shapes)
    for (const double kt : {0.0, 0.5})
      for (const double kr : {0.0, 0.1}) {
        SCOPED_TRACE(testing::Message() << "shapes " << shapes << ", K_T " << kt << ", K_R " << kr);
        const Packing<Dim> packing = angular_packing_with_forces<Dim>(periodic<Dim>(), kinds[shapes]).packing;
        expect_free_motions_cost_nothing(network_of(packing, kt, kr));
      }
}

TEST(NetworkOfCorners, FreeMotionsCostNothing) {
  sweep_stiffnesses<2>();
  sweep_stiffnesses<3>();
}

TEST(NetworkOfCorners, NormalForcesHoldRotationsOfPolygons) {
  const Packing<2> packing =
      angular_packing_with_forces<2>(periodic<2>(), cut_shapes<2>({}, 3, 0.1, 7)).packing;
  EXPECT_EQ(find_free_motions(network_of(packing, 0.0, 0.0)).n_free_spins, 0);
  const Packing<2> disks = angular_packing_with_forces<2>(periodic<2>(), {round_shape<2>(0.5)}).packing;
  EXPECT_EQ(find_free_motions(network_of(disks, 0.0, 0.0)).n_free_spins, disks.grains.size());
}

/// Returns the geometric stiffness of a contact as a matrix.
template <int Dim>
MotionMatrix<Dim> matrix_of(const GeometricSprings<Dim>& springs) {
  return springs.directions * springs.stiffness.asDiagonal() * springs.directions.transpose();
}

/// If a pair rotates as a whole by w, its contact force f rotates with it. To second order, f does the work (w x r).(w
/// x f)/2 with the branch r, for any shapes.
template <int Dim>
void expect_forces_turn_with_a_pair() {
  const Packing<Dim> packing = angular_packing_with_forces<Dim>(periodic<Dim>()).packing;
  const ContactNetwork<Dim> network = contact_network(packing);
  const std::vector<GeometricSprings<Dim>> springs = geometric_springs(packing);
  ASSERT_EQ(springs.size(), network.contacts.size());
  ASSERT_GT(springs.size(), 5u);
  for (const NetworkContact<Dim>& c : network.contacts) {
    const RotationVector<Dim> w = RotationVector<Dim>::LinSpaced(0.3, 1.0);
    const Vec<Dim> force = c.shear_force - c.normal_force * c.normal();
    const Vec<Dim> displacement = cross<double>(w, c.branch);
    Eigen::Matrix<double, kMotionRows<Dim>, 1> motion;
    motion << displacement, w, w;
    EXPECT_NEAR(motion.dot(matrix_of<Dim>(springs[c.source]) * motion),
                displacement.dot(cross<double>(w, force)), 1e-6)
        << c.source;
  }
}

TEST(GeometricSprings, ForcesTurnWithAPair) {
  expect_forces_turn_with_a_pair<2>();
  expect_forces_turn_with_a_pair<3>();
}

/// Returns two boxes of the sides 1 and `side` in a wide cell, of which two faces touch without a force. The smaller
/// one is turned by `tilt` out of the plane of these faces.
template <int Dim>
Packing<Dim> two_boxes(double side, double tilt, bool smaller_first) {
  Packing<Dim> packing;
  packing.law = rigid_law(0.5);
  packing.cell.matrix = 5.0 * Mat<Dim>::Identity();
  Grains<Dim>& g = packing.grains;
  g = Grains<Dim>::with_size(2);
  set_shape(g, box<Dim>(Vec<Dim>::Ones(), 0.0), std::sqrt(static_cast<double>(Dim)));
  const int small = smaller_first ? 0 : 1, large = 1 - small;
  g.scale[small] *= side;
  g.radius[small] *= side;
  g.position[large] = g.position[small] = Vec<Dim>::Constant(2.5);
  // The faces are shifted along each other, so that no two edges coincide.
  g.position[small] += (0.5 + 0.499 * side) * Vec<Dim>::Unit(0);
  for (int a = 1; a < Dim; ++a) g.position[small][a] += 0.1 * a;
  g.orientation[small] = turned(g.orientation[small], RotationVector<Dim>(tilt * RotationVector<Dim>::Ones()));
  packing.contacts = ContactPoints<Dim>().find(packing, 0.1 * side);
  for (std::size_t k = 0; k < packing.contacts.size(); ++k) packing.contacts[k].elastic_force = 1.0;
  return packing;
}

/// Without forces there is no geometric stiffness: the springs of the contact points alone describe how gaps change. In
/// contacts of two nearly parallel faces, small motions must not change the face that defines the contact.
template <int Dim>
void expect_no_springs_without_forces(bool has_other_keys) {
  for (const double side : {0.05, 0.3, 1.0})
    for (const double tilt : {0.0, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5})
      for (const bool smaller_first : {true, false}) {
        Packing<Dim> packing = two_boxes<Dim>(side, tilt, smaller_first);
        ASSERT_GE(packing.contacts.size(), Dim == 2 ? 2u : 4u);
        if (has_other_keys)
          for (std::size_t k = 0; k < packing.contacts.size(); ++k)
            packing.contacts[k].key = static_cast<int>(k);
        ContactNetwork<Dim> network = contact_network(packing);
        for (NetworkContact<Dim>& c : network.contacts) {
          c.kn = 1.0;
          EXPECT_LE(geometric_stiffness(packing, c).cwiseAbs().maxCoeff(), 1e-4)
              << Dim << "D, side " << side << ", tilt " << tilt << ", smaller first: " << smaller_first
              << ", other keys: " << has_other_keys;
        }
      }
}

TEST(GeometricSprings, AreZeroWithoutForces) {
  for (const bool has_other_keys : {false, true}) {
    expect_no_springs_without_forces<2>(has_other_keys);
    expect_no_springs_without_forces<3>(has_other_keys);
  }
}

/// Disks or spheres of one size that are described as shapes must have the geometric stiffness of round grains.
template <int Dim>
void expect_springs_of_round_grains() {
  Packing<Dim> packing = angular_packing_with_forces<Dim>(periodic<Dim>(), {round_shape<Dim>(0.5)}).packing;
  packing.grains.scale.assign(packing.grains.scale.size(), 1.04);
  packing.grains.radius.assign(packing.grains.radius.size(), 0.52);
  packing.contacts = ContactPoints<Dim>().find(packing, 0.0);
  ASSERT_GT(packing.contacts.size(), 10u);
  for (std::size_t k = 0; k < packing.contacts.size(); ++k) {
    Contact<Dim>& c = packing.contacts[k];
    c.normal_force = c.elastic_force = 1.0 + 0.1 * static_cast<double>(k % 7);
    c.shear_force = 0.3 * contact_frame(c.normal).col(1);
  }
  const std::vector<GeometricSprings<Dim>> springs = geometric_springs(packing);
  for (const NetworkContact<Dim>& c : contact_network(packing).contacts) {
    const MotionMatrix<Dim> k = geometric_stiffness(c);
    EXPECT_LE((matrix_of<Dim>(springs[c.source]) - 0.5 * (k + k.transpose())).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(GeometricSprings, OfRoundShapesAreThoseOfRoundGrains) {
  expect_springs_of_round_grains<2>();
  expect_springs_of_round_grains<3>();
}

}  // namespace
}  // namespace floc::test
