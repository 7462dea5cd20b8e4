#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "floc/base/random.h"
#include "floc/lattice/lattice_solution.h"
#include "support/contact_laws.h"

/// Samples on a lattice whose nodes have prescribed or random phases. They do not come from a packing.
namespace floc::test {

/// Returns a sample whose nodes get their phase and grain from a function of the position.
/// @param grain_at  index of a grain, -1 for matrix, -2 for void
template <int Dim>
CementedSample<Dim> sample_of(Lattice<Dim> lattice, const std::function<int(const Vec<Dim>&)>& grain_at) {
  CementedSample<Dim> out;
  out.lattice = std::move(lattice);
  for (const Vec<Dim>& x : out.lattice.node) {
    const int grain = grain_at(x);
    out.phase.push_back(grain >= 0 ? Phase::grain : grain == -1 ? Phase::matrix : Phase::none);
    out.owner.push_back(std::max(grain, grain == -1 ? 0 : -1));
    out.owner_image.push_back(Vec<Dim, int>::Zero());
  }
  return out;
}

/// Returns the network of a lattice of one material, in which all bonds have the same stiffness.
template <int Dim>
LatticeNetwork<Dim> uniform_network(const Lattice<Dim>& lattice, double k, double shear = 0.0,
                                    double bending = 0.0) {
  ElementStiffness stiffness;
  stiffness.matrix = k;
  stiffness.shear = shear;
  stiffness.bending = bending;
  return lattice_network(sample_of<Dim>(lattice, [](const Vec<Dim>&) { return -1; }), stiffness);
}

/// Returns disks or spheres of slightly different sizes on a square or cubic grid, with gaps of `gap` between
/// neighbours.
template <int Dim>
Packing<Dim> grid_of_grains(int across, double gap) {
  Packing<Dim> packing;
  packing.law += test::linear(1.0);
  packing.cell.matrix = Mat<Dim>::Identity() * (across * (1.0 + gap));
  const int n = static_cast<int>(std::pow(across, Dim) + 0.5);
  packing.grains = Grains<Dim>::with_size(n);
  for (int k = 0; k < n; ++k) {
    int rest = k;
    for (int a = 0; a < Dim; ++a, rest /= across)
      packing.grains.position[k][a] = (rest % across + 0.3) * (1.0 + gap);
    packing.grains.radius[k] = 0.5 - 0.02 * (k % 3);
    packing.grains.mass[k] = 1.0;
  }
  return packing;
}

inline RelaxationSettings exactly() {
  RelaxationSettings settings;
  settings.tolerance = 1e-12;
  return settings;
}

template <int Dim>
Eigen::MatrixXd moduli_of(const LatticeNetwork<Dim>& network, const RelaxationSettings& settings = exactly()) {
  LatticeSolver<Dim> solver(network, settings);
  const LatticeSolution<Dim> solution = solver.solve(LatticeLoad<Dim>::uniaxial(Dim - 1, 1.0));
  EXPECT_TRUE(solution.report.converged);
  return solver.moduli();
}

}  // namespace floc::test
