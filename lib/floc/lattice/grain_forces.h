#pragma once

#include <optional>
#include <vector>

#include "floc/lattice/lattice_solution.h"
#include "floc/packing/packing.h"

namespace floc {

/// Force between two grains of a cemented sample: the sum over all elements between their regions. A region is a grain
/// with the matrix nearest to it.
template <int Dim>
struct GrainForce {
  int i, j;                    ///< numbers of the two grains, i <= j
  Vec<Dim, int> image;         ///< image of grain j: branch = centre[j] + image * cell.matrix - centre[i]
  Vec<Dim> branch;             ///< vector between the centres of the grains (length)
  double normal;               ///< force along the branch, compression positive (force)
  Vec<Dim> shear;              ///< force across the branch on grain i (force)
  RotationVector<Dim> moment;  ///< moment on grain i about the contact point (force * length)
  /// Stiffnesses along and across the branch: sums over the elements that carry force (force/length).
  double kn, kt;
};

/// Returns the forces between grains, sorted by (i, j, image). They balance on every grain, except for forces that hold
/// nodes, and carry the stress sigma of the cell: the sum of the tensor products of branch and force is exactly V
/// sigma, with the volume V.
template <int Dim>
std::vector<GrainForce<Dim>> grain_forces(const CementedSample<Dim>& sample, const LatticeNetwork<Dim>& network,
                                          const LatticeSolution<Dim>& solution);

/// Returns a packing of the grains of a cemented sample, with the given forces in its contacts. It can be used by every
/// command for contact networks.
/// @param packing  packing from which the sample was made; the masses are taken from it
template <int Dim>
Packing<Dim> packing_of(const CementedSample<Dim>& sample, const Packing<Dim>& packing,
                        const std::vector<GrainForce<Dim>>& forces);

/// Correlation of the normal forces in two lists of contacts, over the pairs of grains that are in both lists.
struct ForceAgreement {
  std::optional<double> pearson;  ///< Pearson's coefficient; absent for fewer than 3 pairs or equal forces
  int n_common = 0;               ///< number of pairs of grains in both lists
};
/// Compares the normal forces of two lists of contacts.
/// @param forces                  first list
/// @param contacts, normal_force  second list: contacts, and their normal forces (force)
template <int Dim>
ForceAgreement agreement(const std::vector<GrainForce<Dim>>& forces, const std::vector<Contact<Dim>>& contacts,
                         const std::vector<double>& normal_force);

}  // namespace floc
