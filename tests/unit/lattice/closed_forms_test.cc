#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "floc/lattice/fracture.h"
#include "floc/lattice/irregular_lattice.h"
#include "floc/lattice/node_stress.h"
#include "floc/lattice/phase_bounds.h"
#include "support/lattice_samples.h"

namespace floc {
namespace {

using test::exactly;
using test::moduli_of;
using test::sample_of;
using test::uniform_network;

/// Returns a lattice of bonds between the points of a face-centred cubic crystal: neighbours with stiffness 1,
/// second neighbours with stiffness `second`.
LatticeNetwork<3> fcc(double second) {
  const double l = 1.0, side = std::numbers::sqrt2 * l;
  const int across = 2;
  LatticeNetwork<3> out;
  Cell<3> cell;
  cell.matrix = Mat<3>::Identity() * (across * side);
  std::vector<Vec<3>> points;
  const Vec<3> basis[] = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
  for (int x = 0; x < across; ++x)
    for (int y = 0; y < across; ++y)
      for (int z = 0; z < across; ++z)
        for (const Vec<3>& b : basis) points.push_back(side * (Vec<3>(x, y, z) + b));
  out.n_nodes = static_cast<int>(points.size());
  out.volume = cell.volume();
  out.spacing = l;
  out.present.assign(points.size(), true);
  for (int i = 0; i < out.n_nodes; ++i)
    for (int j = 0; j < out.n_nodes; ++j)
      for (int n = 0; n < 27; ++n) {
        const Vec<3, int> image(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
        const Vec<3> branch = points[j] + cell.shift(image) - points[i];
        // The loop meets each bond twice, from both of its ends. The bond is added from one end only: the end from
        // which the first non-zero component of the branch is positive.
        int axis = 0;
        while (axis < 3 && std::abs(branch[axis]) < 1e-9) ++axis;
        if (axis == 3 || branch[axis] < 0.0) continue;
        const double k = std::abs(branch.norm() - l) < 1e-9      ? 1.0
                         : std::abs(branch.norm() - side) < 1e-9 ? second
                                                                 : 0.0;
        if (k > 0.0) out.elements.push_back({i, j, image, branch, 0.5 * branch, k, ElementKind::matrix, false});
      }
  return out;
}

/// Compares the moduli of a face-centred cubic lattice with their closed forms.
TEST(Fcc, HasItsClosedFormsWithAndWithoutSecondNeighbours) {
  const Eigen::MatrixXd alone = moduli_of(fcc(0.0));
  const double root2 = std::numbers::sqrt2;
  EXPECT_NEAR(alone(0, 0), root2, 1e-9);
  EXPECT_NEAR(alone(0, 1), root2 / 2, 1e-9);
  EXPECT_NEAR(alone(3, 3), root2 / 2, 1e-9);
  const Eigen::MatrixXd isotropic = moduli_of(fcc(0.25));
  for (int a = 0; a < 3; ++a) {
    EXPECT_NEAR(isotropic(a, a), 3 / root2, 1e-9);
    EXPECT_NEAR(isotropic(a, (a + 1) % 3), 1 / root2, 1e-9);
    EXPECT_NEAR(isotropic(3 + a, 3 + a), 1 / root2, 1e-9);
  }
}

Lattice<3> irregular(double side, double spacing) {
  Cell<3> cell;
  cell.matrix = Mat<3>::Identity() * side;
  return irregular_lattice(cell, {.spacing = spacing, .jitter = 0.35, .seed = 4});
}

TEST(IrregularLattice, FillsTheCellAndClosesEveryVoronoiCell) {
  Cell<3> cell;
  cell.matrix << 5.0, 0.0, 0.0, 1.0, 6.0, 0.0, 0.5, -1.0, 4.0;
  const Lattice<3> lattice = irregular_lattice(cell, {.spacing = 0.8});
  double volume = 0.0;
  for (const double v : lattice.volume) volume += v;
  EXPECT_NEAR(volume / cell.volume(), 1.0, 1e-9);
  std::vector<Vec<3>> outwards(lattice.node.size(), Vec<3>::Zero());
  std::vector<double> cones(lattice.node.size(), 0.0);
  for (const LatticeBond<3>& b : lattice.bonds) {
    const Vec<3> n = b.branch.normalized();
    outwards[b.i] += b.facet * n;
    outwards[b.j] -= b.facet * n;
    cones[b.i] += b.facet * b.branch.norm() / 6.0;
    cones[b.j] += b.facet * b.branch.norm() / 6.0;
    EXPECT_NEAR(b.arm_i.dot(n), 0.5 * b.branch.norm(), 1e-9);
    EXPECT_LT((lattice.node[b.j] + cell.shift(b.image) - lattice.node[b.i] - b.branch).norm(), 1e-12);
  }
  for (int k = 0; k < lattice.n_nodes(); ++k) {
    EXPECT_LT(outwards[k].norm(), 1e-9);
    EXPECT_NEAR(cones[k], lattice.volume[k], 1e-9);
  }
  EXPECT_NEAR(static_cast<double>(lattice.bonds.size()) / lattice.n_nodes(), 7.77, 0.3);
}

/// The springs act at the centres of the faces between the cells of the nodes and have the stiffnesses K_N = K_T = E
/// s/l (s: area of the face, l: distance of the two nodes). With such springs, every lattice deforms like a homogeneous
/// continuum with nu = 0.
TEST(IrregularLattice, OfBeamsByFacetIsAHomogeneousContinuum) {
  const Lattice<3> lattice = irregular(4.0, 1.0);
  ElementStiffness stiffness;
  stiffness.matrix = 2.0;
  stiffness.shear = 1.0;
  stiffness.by_facet = true;
  const CementedSample<3> sample = sample_of<3>(lattice, [](const Vec<3>&) { return -1; });
  const LatticeNetwork<3> network = lattice_network(sample, stiffness);
  LatticeSolver<3> solver(network, exactly());
  const LatticeSolution<3> s = solver.solve(LatticeLoad<3>::uniaxial(2, 1.0));
  ASSERT_TRUE(s.report.converged);
  EXPECT_NEAR(s.strain[2], 0.5, 1e-9);
  EXPECT_NEAR(s.strain[0], 0.0, 1e-9);
  Mat<3> expected = Mat<3>::Zero();
  expected(2, 2) = 1.0;
  for (const Mat<3>& stress : node_stress(lattice, network, s)) EXPECT_LT((stress - expected).norm(), 1e-8);
}

TEST(IrregularLattice, OfEqualSpringsScattersTheStressOfItsNodesByAQuarter) {
  const Lattice<3> lattice = irregular(9.0, 1.0);
  const LatticeNetwork<3> network = uniform_network(lattice, 1.0);
  LatticeSolver<3> solver(network, {});
  const LatticeSolution<3> s = solver.solve(LatticeLoad<3>::uniaxial(1, 1.0));
  ASSERT_TRUE(s.report.converged);
  std::vector<double> values;
  for (const Mat<3>& stress : node_stress(lattice, network, s)) values.push_back(stress(1, 1));
  EXPECT_NEAR(stress_distribution(values, 1.0).spread, 0.25, 0.03);
}

TEST(IterativeSolver, EqualsTheFactor) {
  const Lattice<3> lattice = irregular(5.0, 1.0);
  RandomStream random(2, 0);
  ElementStiffness stiffness;
  stiffness.grain = 50.0;
  const CementedSample<3> sample = sample_of<3>(
      lattice, [&](const Vec<3>& x) { return random.uniform() < 0.5 ? -1 : static_cast<int>(x[0] / 2.5); });
  const LatticeNetwork<3> network = lattice_network(sample, stiffness);
  RelaxationSettings by_factor = exactly(), by_blocks = exactly();
  by_factor.method = LatticeMethod::factor;
  by_blocks.method = LatticeMethod::iterative;
  LatticeSolver<3> direct(network, by_factor), iterative(network, by_blocks);
  const LatticeSolution<3> a = direct.solve(LatticeLoad<3>::uniaxial(0, -1.0));
  const LatticeSolution<3> b = iterative.solve(LatticeLoad<3>::uniaxial(0, -1.0));
  ASSERT_TRUE(a.report.converged && b.report.converged);
  EXPECT_GT(a.n_open(), 0);
  for (std::size_t e = 0; e < network.elements.size(); ++e)
    EXPECT_NEAR(a.normal_force[e], b.normal_force[e], 1e-8);
  EXPECT_LT((direct.moduli() - iterative.moduli()).cwiseAbs().maxCoeff(), 1e-8);
}

/// Returns a sample with one disk in a square cell of six diameters.
CementedSample<2> disk_in_sheet(double diameter_in_spacings) {
  const int columns = static_cast<int>(std::lround(6.0 * diameter_in_spacings));
  const int rows = 2 * static_cast<int>(std::lround(columns / std::numbers::sqrt3));
  const Lattice<2> lattice = triangular_lattice(columns, rows, 1.0);
  const Vec<2> middle = 0.5 * lattice.cell.matrix.diagonal();
  return sample_of<2>(
      lattice, [&](const Vec<2>& x) { return (x - middle).norm() < 0.5 * diameter_in_spacings ? 0 : -1; });
}

/// A disk that is stiffer or softer than the sheet around it has a uniform stress.
TEST(Inclusion, OfAStifferDiskHasTheUniformStressOfTheContinuum) {
  for (const auto& [c, expected, tolerance] :
       {std::tuple{100.0, 1.4925, 0.012}, std::tuple{10.0, 1.4286, 0.012}, std::tuple{0.1, 0.25, 0.05}}) {
    const CementedSample<2> sample = disk_in_sheet(20.0);
    ElementStiffness stiffness;
    stiffness.grain = c;
    const LatticeNetwork<2> network = lattice_network(sample, stiffness);
    LatticeSolver<2> solver(network, exactly());
    const LatticeSolution<2> s = solver.solve(LatticeLoad<2>::uniaxial(1, 1.0));
    const std::vector<Mat<2>> stress = node_stress(sample.lattice, network, s);
    double mean = 0.0;
    int n = 0;
    for (int k = 0; k < sample.lattice.n_nodes(); ++k)
      if (sample.phase[k] == Phase::grain) mean += stress[k](1, 1), ++n;
    EXPECT_NEAR(mean / n, expected, tolerance * expected) << c;
  }
}

/// A hexagonal array of disks fills 30 % of the area. The disks are a hundred times stiffer than the matrix.
TEST(Composite, OfDisksLiesAtTheLowerBoundOfHashinAndShtrikman) {
  // A rectangular cell with two disks gives the hexagonal array.
  const int columns = 40;
  const Lattice<2> two = triangular_lattice(columns, 2 * columns, 1.0);
  const double r = std::sqrt(0.3 * two.cell.volume() / 2 / std::numbers::pi);
  const Vec<2> sides = two.cell.matrix.diagonal();
  const CementedSample<2> sample = sample_of<2>(two, [&](const Vec<2>& x) {
    for (int n = 0; n < 2; ++n) {
      Vec<2> d = x - (0.25 + 0.5 * n) * sides;
      for (int a = 0; a < 2; ++a) d[a] -= sides[a] * std::round(d[a] / sides[a]);
      if (d.norm() < r) return n;
    }
    return -1;
  });
  ElementStiffness stiffness;
  stiffness.grain = 100.0;
  stiffness.contact = BareContact::bilateral;
  const LatticeNetwork<2> network = lattice_network(sample, stiffness);
  const Eigen::MatrixXd C = moduli_of(network);
  double share = 0.0;
  for (const Phase phase : sample.phase) share += phase == Phase::grain ? 1.0 / two.n_nodes() : 0.0;
  const CompositeBounds bounds =
      composite_bounds({triangular_moduli(share, 100.0, 0.0), triangular_moduli(1 - share, 1.0, 0.0)}, 2);
  const double K = 0.25 * (C(0, 0) + C(1, 1) + 2 * C(0, 1)), G = C(2, 2);
  EXPECT_GT(K, bounds.K.hashin_shtrikman_lower);
  EXPECT_NEAR(K / bounds.K.hashin_shtrikman_lower, 1.0, 0.02);
  EXPECT_LT(K, bounds.K.hashin_shtrikman_upper);
  EXPECT_GT(G, bounds.G.hashin_shtrikman_lower);
  EXPECT_LT(G, bounds.G.hashin_shtrikman_upper);
  EXPECT_LT(bounds.K.reuss, bounds.K.hashin_shtrikman_lower);
  EXPECT_LT(bounds.K.hashin_shtrikman_upper, bounds.K.voigt);
}

TEST(CompositeBounds, AreClosedFormsAndVanishWithVoids) {
  const ElasticPhase stiff{0.3, 10.0, 5.0}, soft{0.7, 1.0, 0.5};
  const CompositeBounds b = composite_bounds({stiff, soft}, 2);
  EXPECT_NEAR(b.K.hashin_shtrikman_lower, 1.0 + 0.3 / (1 / 9.0 + 0.7 / 1.5), 1e-12);
  EXPECT_NEAR(b.K.voigt, 3.7, 1e-12);
  EXPECT_NEAR(b.K.reuss, 1 / (0.03 + 0.7), 1e-12);
  const CompositeBounds in_space = composite_bounds({stiff, soft}, 3);
  EXPECT_NEAR(in_space.K.hashin_shtrikman_lower, 1.0 + 0.3 / (1 / 9.0 + 0.7 / (1.0 + 4.0 / 3 * 0.5)), 1e-12);
  const CompositeBounds with_voids = composite_bounds({stiff, {0.7, 0.0, 0.0}}, 2);
  EXPECT_EQ(with_voids.K.hashin_shtrikman_lower, 0.0);
  EXPECT_EQ(with_voids.G.reuss, 0.0);
  EXPECT_GT(with_voids.K.hashin_shtrikman_upper, 0.0);
  const CompositeBounds one = composite_bounds({{1.0, 3.0, 2.0}}, 3);
  EXPECT_NEAR(one.G.hashin_shtrikman_lower, 2.0, 1e-12);
  EXPECT_NEAR(one.G.hashin_shtrikman_upper, 2.0, 1e-12);
}

TEST(CompositeBounds, IgnoreSharesThatAreRoundingErrors) {
  const ElasticPhase stiff{0.3, 10.0, 5.0}, soft{0.7, 1.0, 0.5};
  const CompositeBounds with = composite_bounds({stiff, soft, {2e-16, 0.0, 0.0}}, 3);
  const CompositeBounds without = composite_bounds({stiff, soft}, 3);
  EXPECT_GT(with.K.reuss, 0.0);
  EXPECT_EQ(with.K.reuss, without.K.reuss);
  EXPECT_EQ(with.G.hashin_shtrikman_lower, without.G.hashin_shtrikman_lower);
}

TEST(CompositeBounds, HoldOnlyIfInterfacesAndContactsAreThoseOfBondedPhases) {
  RandomStream random(9, 0);
  const CementedSample<2> sample = sample_of<2>(triangular_lattice(10, 10, 1.0), [&](const Vec<2>& x) {
    return random.uniform() < 0.2 ? -1 : static_cast<int>(x[0] / 5.0);
  });
  const auto holding = [&](const std::function<void(ElementStiffness&)>& change, int n_open = 0) {
    ElementStiffness stiffness;
    stiffness.grain = 10.0;
    stiffness.contact = BareContact::bilateral;
    change(stiffness);
    ElementStiffness without_patch = stiffness;
    without_patch.patch.reset();  // a patch needs the positions of grains, which this sample does not have
    const BoundsThatHold hold = bounds_that_hold(lattice_network(sample, without_patch), stiffness, n_open);
    return std::pair(hold.upper, hold.lower);
  };
  using Both = std::pair<bool, bool>;
  EXPECT_EQ(holding([](ElementStiffness&) {}), Both(true, true));
  EXPECT_EQ(holding([](ElementStiffness& s) { s.interface = 100.0; }), Both(false, true));
  EXPECT_EQ(holding([](ElementStiffness& s) { s.interface = 0.0; }), Both(true, false));
  EXPECT_EQ(holding([](ElementStiffness& s) { s.bare = 20.0; }), Both(false, true));
  EXPECT_EQ(holding([](ElementStiffness& s) { s.bare = 1.0, s.interface = 50.0; }), Both(false, false));
  EXPECT_EQ(holding([](ElementStiffness& s) { s.contact = BareContact::none; }), Both(true, false));
  EXPECT_EQ(holding([](ElementStiffness& s) { s.patch = 0.1; }), Both(true, false));
  EXPECT_EQ(holding([](ElementStiffness& s) { s.contact = BareContact::unilateral; }), Both(true, true));
  EXPECT_EQ(holding([](ElementStiffness& s) { s.contact = BareContact::unilateral; }, 1), Both(true, false));
}

TEST(StressDistribution, GivesRoundingErrorsNeitherSign) {
  const std::vector<double> real = {0.5, 1.0, 2.0, 4.0, -1.0, 1e-4};
  std::vector<double> positive = real, negative = real;
  for (int n = 0; n < 20; ++n) positive.push_back(1e-9), negative.push_back(-1e-9);
  const StressDistribution p = stress_distribution(positive, 1.0), n = stress_distribution(negative, 1.0);
  EXPECT_EQ(p.other_share, 1.0 / 26);
  EXPECT_EQ(n.other_share, p.other_share);
  EXPECT_DOUBLE_EQ(p.unit, 7.5001 / 5);
  EXPECT_EQ(n.unit, p.unit);
  EXPECT_EQ(n.loaded_1.n, p.loaded_1.n);
  EXPECT_EQ(n.largest, p.largest);
  const StressDistribution none = stress_distribution({1e-9, -3e-9, 1e-10}, 1.0, 1e-6);
  EXPECT_EQ(none.other_share, 0.0);
  EXPECT_EQ(none.unit, 0.0);
  EXPECT_TRUE(std::isnan(none.spread));
}

/// The plates lie at the fixed rows of nodes. Of a homogeneous lattice, only the elements that cross the free sides are
/// missing: half a column.
TEST(Boundary, OfPlatesGivesTheModulusOfAHomogeneousLattice) {
  for (const auto& [columns, rows, axis] :
       {std::tuple{40, 16, 1}, std::tuple{40, 60, 1}, std::tuple{20, 60, 0}})
    for (const LatticeBoundary boundary : {LatticeBoundary::plates, LatticeBoundary::bonded_plates}) {
      const CementedSample<2> sample =
          sample_of<2>(triangular_lattice(columns, rows, 1.0), [](const Vec<2>&) { return -1; });
      const LatticeNetwork<2> network = lattice_network(sample, {}, boundary, axis);
      LatticeSolver<2> solver(network, exactly(), boundary, axis);
      const LatticeSolution<2> s = solver.solve(LatticeLoad<2>::uniaxial(axis, 1.0));
      ASSERT_TRUE(s.report.converged);
      const double E = s.stress[axis] / s.strain[axis] / (2.0 / std::numbers::sqrt3);
      if (boundary == LatticeBoundary::plates)
        EXPECT_NEAR(E, 1.0, 0.015) << columns << ' ' << rows << ' ' << axis;
      // Plates to which the sample sticks hinder its transverse strain.
      else
        EXPECT_GT(E, 0.99) << columns << ' ' << rows << ' ' << axis;
    }
}

/// A disk lies between two plates and touches each plate with a few nodes.
TEST(Disk, PressedOnADiameterHasTheStressOfTheContinuumAtItsCentre) {
  const int across = 60;
  const int rows = 2 * static_cast<int>(std::lround(across / std::numbers::sqrt3));
  const Lattice<2> lattice = triangular_lattice(across + 6, rows, 1.0);
  const Vec<2> middle = 0.5 * lattice.cell.matrix.diagonal();
  const double diameter = (rows - 1) * std::numbers::sqrt3 / 2;  // from the lowest to the highest row of nodes
  const CementedSample<2> sample = sample_of<2>(
      lattice, [&](const Vec<2>& x) { return (x - middle).norm() < 0.5 * diameter + 0.05 ? 0 : -2; });
  const LatticeNetwork<2> network = lattice_network(sample, {}, LatticeBoundary::plates, 1);
  LatticeSolver<2> solver(network, exactly(), LatticeBoundary::plates, 1);
  const LatticeSolution<2> s = solver.solve(LatticeLoad<2>::uniaxial(1, 1.0));
  ASSERT_TRUE(s.report.converged);
  const double P = network.volume / diameter;
  const std::vector<Mat<2>> stress = node_stress(lattice, network, s);
  Mat<2> mean = Mat<2>::Zero();
  int n = 0;
  for (int k = 0; k < lattice.n_nodes(); ++k)
    if ((lattice.node[k] - middle).norm() < 2.0) mean += stress[k], ++n;
  mean /= n;
  EXPECT_NEAR(mean(0, 0) / (-2 * P / (std::numbers::pi * diameter)), 1.0, 0.04);
  EXPECT_NEAR(mean(1, 1) / (6 * P / (std::numbers::pi * diameter)), 1.0, 0.03);
}

/// Prescribed displacements of the nodes at the boundary make the sample stiffer than a periodic cell.
TEST(Boundary, OfUniformStrainIsStifferThanAPeriodicCell) {
  RandomStream random(8, 0);
  const CementedSample<2> sample = sample_of<2>(triangular_lattice(14, 14, 1.0),
                                                [&](const Vec<2>&) { return random.uniform() < 0.4 ? 0 : -1; });
  // A boundary that is not periodic also removes elements of the lattice. Moduli are therefore divided by those of a
  // homogeneous lattice with the same boundary.
  const auto relative = [&](LatticeBoundary boundary) {
    Eigen::VectorXd diagonal[2];
    for (const int uniform : {0, 1}) {
      ElementStiffness stiffness;
      stiffness.grain = uniform == 1 ? 1.0 : 30.0;
      stiffness.contact = BareContact::bilateral;
      const LatticeNetwork<2> network = lattice_network(sample, stiffness, boundary, 1);
      LatticeSolver<2> solver(network, exactly(), boundary, 1);
      EXPECT_TRUE(solver.solve(LatticeLoad<2>::uniaxial(1, 1.0)).report.converged);
      diagonal[uniform] = solver.moduli().diagonal();
    }
    return Eigen::VectorXd(diagonal[0].cwiseQuotient(diagonal[1]));
  };
  const Eigen::VectorXd periodic = relative(LatticeBoundary::periodic);
  const Eigen::VectorXd held = relative(LatticeBoundary::uniform_strain);
  for (int a = 0; a < 3; ++a) EXPECT_GT(held[a], periodic[a]) << a;
  EXPECT_LT(relative(LatticeBoundary::plates)[1], relative(LatticeBoundary::bonded_plates)[1]);
}

/// The first bond of a triangular lattice breaks at a stress with a closed form.
TEST(Fracture, OfATriangularLatticeBeginsAtItsClosedForm) {
  const double l = 0.5, f_c = 3.0;
  const LatticeNetwork<2> network = uniform_network(triangular_lattice(6, 6, l), 1.0);
  for (const int axis : {0, 1}) {
    const double expected = (axis == 0 ? 2 / std::numbers::sqrt3 : std::numbers::sqrt3) * f_c / l;
    LatticeSolver<2> solver(network, exactly());
    FractureOptions options;
    options.strength.tension.fill(f_c);
    options.most_broken = 1;
    const FracturePath path = fracture(network, solver, LatticeLoad<2>::uniaxial(axis, -1.0), axis, options);
    ASSERT_EQ(path.broken.size(), 1u);
    EXPECT_NEAR(path.broken[0].stress, -expected, 1e-8 * expected);
    EXPECT_NEAR(path.strength, expected, 1e-8 * expected);
  }
}

/// Under a shear stress s, the bonds across the rows of a triangular lattice carry s l and -s l, and those along the
/// rows carry nothing.
TEST(Fracture, UnderShearIsMeasuredByTheShearStress) {
  const double l = 0.5, f_c = 3.0;
  const LatticeNetwork<2> network = uniform_network(triangular_lattice(6, 6, l), 1.0);
  LatticeSolver<2> solver(network, exactly());
  FractureOptions options;
  options.strength.tension.fill(f_c);
  options.most_broken = 1;
  LatticeLoad<2> load;
  load.value[2] = 1.0;
  const FracturePath path = fracture(network, solver, load, 1, options);
  ASSERT_EQ(path.broken.size(), 1u);
  EXPECT_NEAR(path.strength, f_c / l, 1e-8);
  EXPECT_NEAR(path.strain_at_strength, f_c / l / (std::numbers::sqrt3 / 4), 1e-7);
}

TEST(Fracture, IsMeasuredAlongTheAxisUnlessTheLoadHasNoStressThere) {
  const auto measured = [](double xx, double yy, double xy) {
    LatticeLoad<2> load;
    load.value << xx, yy, xy;
    return measured_component(load, 1);
  };
  EXPECT_EQ(measured(0.0, -1.0, 0.0), 1);
  EXPECT_EQ(measured(5.0, 0.1, 3.0), 1);
  EXPECT_EQ(measured(1.0, 0.0, -3.0), 2);
  EXPECT_EQ(measured(-4.0, 1e-9, 3.0), 0);
}

TEST(Fracture, EndsWhenNothingHoldsAndRemovesOneElementATime) {
  const LatticeNetwork<2> network = uniform_network(triangular_lattice(8, 8, 1.0), 1.0);
  LatticeSolver<2> solver(network, {});
  FractureOptions options;
  options.strength.tension.fill(1.0);
  options.end_at = 0.01;
  const FracturePath path = fracture(network, solver, LatticeLoad<2>::uniaxial(1, -1.0), 1, options);
  EXPECT_GE(path.broken.size(), 8u);  // a crack crosses the sample
  EXPECT_LT(path.broken.size(), network.elements.size());
  EXPECT_FALSE(path.end.empty());
  std::set<int> once;
  for (const Breakage& b : path.broken) EXPECT_TRUE(once.insert(b.element).second);
}

}  // namespace
}  // namespace floc
