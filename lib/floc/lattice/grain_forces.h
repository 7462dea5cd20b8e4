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
  double normal;               ///< along the branch, compression positive (force)
  Vec<Dim> shear;              ///< the rest, on i (force)
  RotationVector<Dim> moment;  ///< on i about the point of contact (force * length)
  double kn, kt;  ///< of the elements that carry, side by side, along and across the branch (force/length)
};

/// Forces between grains, sorted by (i, j, image). They balance on every grain, apart from the forces that hold
/// nodes, and carry the stress of the cell: V sigma = sum of branch x force, exactly.
template <int Dim>
std::vector<GrainForce<Dim>> grain_forces(const CementedSample<Dim>& sample, const LatticeNetwork<Dim>& network,
                                          const LatticeSolution<Dim>& solution);

/// The grains with these forces in their contacts, as a packing that every command for contact networks reads.
/// @param packing  that the sample was made from; supplies the masses
template <int Dim>
Packing<Dim> packing_of(const CementedSample<Dim>& sample, const Packing<Dim>& packing,
                        const std::vector<GrainForce<Dim>>& forces);

/// Pearson's coefficient of the normal forces in two lists, over the pairs of grains that both have; nothing
/// where fewer than three are common or one list does not vary.
struct ForceAgreement {
  std::optional<double> pearson;
  int n_common = 0;
};
template <int Dim>
ForceAgreement agreement(const std::vector<GrainForce<Dim>>& forces, const std::vector<Contact<Dim>>& contacts,
                         const std::vector<double>& normal_force);

}  // namespace floc
