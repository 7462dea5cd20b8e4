#pragma once

#include <optional>
#include <vector>

#include "floc/lattice/lattice_solution.h"
#include "floc/packing/packing.h"

namespace floc {

/// Force between two grains, through all elements between their regions. A region is a grain with the matrix
/// nearest to it.
template <int Dim>
struct GrainForce {
  int i, j;                    ///< grains, i <= j
  Vec<Dim, int> image;         ///< branch = centre[j] + image * cell.matrix - centre[i]
  Vec<Dim> branch;             ///< (length)
  double normal;               ///< force along the branch, compression positive (force)
  Vec<Dim> shear;              ///< force across the branch, on i (force)
  RotationVector<Dim> moment;  ///< moment on i about the point of contact (force * length)
  /// Stiffness along and across the branch of the elements that carry, in parallel (force/length).
  double kn, kt;
};

/// Returns the forces between grains, sorted by (i, j, image). They balance on every grain, apart from the
/// forces that hold nodes, and carry the stress of the cell: V sigma is exactly the sum of the tensor products
/// of branch and force.
template <int Dim>
std::vector<GrainForce<Dim>> grain_forces(const CementedSample<Dim>& sample, const LatticeNetwork<Dim>& network,
                                          const LatticeSolution<Dim>& solution);

/// Returns the grains with these forces in their contacts, as a packing that every command for contact networks
/// reads.
/// @param packing  packing that the sample was made from, for the masses
template <int Dim>
Packing<Dim> packing_of(const CementedSample<Dim>& sample, const Packing<Dim>& packing,
                        const std::vector<GrainForce<Dim>>& forces);

/// Pearson's coefficient of the normal forces in two lists, over the pairs of grains that occur in both; absent
/// if fewer than three pairs are common or one list does not vary.
struct ForceAgreement {
  std::optional<double> pearson;
  int n_common = 0;
};
/// Compares the normal forces of two lists of contacts.
/// @param contacts, normal_force  second list: contacts and their normal forces (force)
template <int Dim>
ForceAgreement agreement(const std::vector<GrainForce<Dim>>& forces, const std::vector<Contact<Dim>>& contacts,
                         const std::vector<double>& normal_force);

}  // namespace floc
