#include "floc/structure/particle_stress.h"

#include <gtest/gtest.h>

#include <cmath>

#include "floc/packing/balance.h"
#include "floc/structure/pressure_phases.h"
#include "support/lattices.h"

namespace floc::test {
namespace {

/// Returns a packing whose contacts have arbitrary forces.
template <int Dim>
Packing<Dim> loaded_packing() {
  Packing<Dim> packing = random_packing<Dim>(30, 5, elastic_law(1.0, 0.5, 0.1));
  std::mt19937 engine(3);
  std::normal_distribution<double> normal;
  for (Contact<Dim>& c : packing.contacts) {
    c.normal_force = normal(engine);
    for (int a = 0; a < Dim; ++a) c.shear_force[a] = normal(engine);
    c.shear_force -= c.normal * c.normal.dot(c.shear_force);
  }
  return packing;
}

template <int Dim>
void expect_sum_is_that_of_the_cell() {
  const Packing<Dim> packing = loaded_packing<Dim>();
  const double phi = solid_fraction(packing);
  Mat<Dim> sum = Mat<Dim>::Zero();
  const std::vector<Mat<Dim>> stress = particle_stress(packing);
  for (int i = 0; i < packing.grains.size(); ++i) {
    const double R = packing.grains.radius[i];
    const double volume = std::acos(-1.0) * R * R * (Dim == 2 ? 1.0 : 4.0 / 3.0 * R);
    sum += volume / phi * stress[i];
    EXPECT_DOUBLE_EQ(particle_pressure(packing)[i], stress[i].trace() / Dim);
  }
  const Mat<Dim> whole = packing.cell.volume() * static_stress(packing);
  EXPECT_LT((sum - whole).norm(), 1e-13 * static_cast<double>(packing.contacts.size()));
}

TEST(ParticleStress, TimesVolumeAddsUpToTheStressOfTheCell) {
  expect_sum_is_that_of_the_cell<2>();
  expect_sum_is_that_of_the_cell<3>();
}

TEST(ParticleStress, IsTheLoadOnALattice) {
  const Packing<2> packing = square_frames(2, 1.0, elastic_law(100.0, 0.0, 0.0));
  const double force = 100.0 * 0.02;
  EXPECT_LT((particle_stress(packing)[0] - force * Mat<2>::Identity()).norm(), 1e-12);
}

TEST(PressurePhases, AreJoinedByContactsAndPercolateWhereTheyWind) {
  // Square lattice of four columns and three rows. Three grains are under tension: two in the second column, and one
  // more. One grain is neutral, and all others are under pressure.
  std::vector<Vec<2>> places;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x) places.emplace_back(x, y);
  Mat<2> cell;
  cell << 4.0, 0.0, 0.0, 3.0;
  const ContactNetwork<2> network = contact_network(disks(cell, places, 1.0, elastic_law(1.0, 0.0, 0.0)));
  const std::vector<double> pressure = {1, -1, 1, 1,  //
                                        1, -1, 1, 1,  //
                                        1, 2,  0, -3};
  const PressurePhases phases = pressure_phases(network, pressure);
  EXPECT_EQ(phases.positive.n_grains, 8);
  EXPECT_EQ(phases.negative.n_grains, 3);
  EXPECT_DOUBLE_EQ(phases.positive.share, 8.0 / 12.0);
  EXPECT_DOUBLE_EQ(phases.positive.mean, 9.0 / 8.0);
  EXPECT_DOUBLE_EQ(phases.negative.mean, -5.0 / 3.0);
  EXPECT_EQ(phases.positive.n_clusters, 1);
  EXPECT_EQ(phases.positive.n_directions, 1);  // the first column crosses the cell vertically
  EXPECT_EQ(phases.negative.n_clusters, 2);
  EXPECT_EQ(phases.negative.largest_cluster, 2);
  EXPECT_EQ(phases.negative.n_directions, 0);
  const std::vector<double> all(12, -1.0);
  EXPECT_EQ(pressure_phases(network, all).negative.n_directions, 2);
  EXPECT_EQ(pressure_phases(network, all).positive.n_grains, 0);
}

}  // namespace
}  // namespace floc::test
