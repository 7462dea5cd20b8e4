#pragma once

#include <optional>
#include <vector>

#include "floc/lattice/lattice_solution.h"
#include "floc/packing/packing.h"

namespace floc {

/// Force between two grains of a cemented sample: the sum over the lattice elements that join their regions. The region
/// of a grain consists of its own nodes and of the matrix nodes that are nearest to it.
template <int Dim>
struct GrainForce {
  int i, j;             ///< numbers of the two grains, i <= j
  Vec<Dim, int> image;  ///< periodic image of grain j: branch = centre[j] + image * cell.matrix - centre[i]
  Vec<Dim> branch;      ///< vector from the centre of grain i to the centre of the image of grain j (length)
  double normal;        ///< force along the branch, compression positive (force)
  Vec<Dim> shear;       ///< force on grain i across the branch (force)
  RotationVector<Dim> moment;  ///< moment on grain i about the contact point (force * length)
  /// Stiffnesses along and across the branch (force/length): sums over those elements between the two grains that carry
  /// a force.
  double kn, kt;
};

/// Returns the forces between the grains of a cemented sample, sorted by (i, j, image). Together with the forces that
/// keep fixed nodes in place, they balance on every grain. They also give the stress sigma of the cell: the sum of the
/// tensor products of branch and force is exactly V sigma, with the volume V of the cell.
template <int Dim>
std::vector<GrainForce<Dim>> grain_forces(const CementedSample<Dim>& sample, const LatticeNetwork<Dim>& network,
                                          const LatticeSolution<Dim>& solution);

/// Returns a packing of the grains of a cemented sample, with contacts that carry the given forces. Every command that
/// works on a contact network can be applied to this packing.
/// @param packing  packing from which the sample was made; the masses of the grains are taken from it
template <int Dim>
Packing<Dim> packing_of(const CementedSample<Dim>& sample, const Packing<Dim>& packing,
                        const std::vector<GrainForce<Dim>>& forces);

/// Returns the contacts of another state of the grains of a sample, with periodic images that belong to the positions
/// of the grains in the sample. The image of a contact depends on the periodic images in which a state stores its
/// grains, and two states of the same grains may store different ones. The image of the sample is chosen whose branch
/// is nearest to the branch of the contact, both in units of the lattice vectors of their cells.
/// @param other  state of the same grains, in the same order
template <int Dim>
std::vector<Contact<Dim>> contacts_in_images_of(const CementedSample<Dim>& sample, const Packing<Dim>& other);

/// Agreement between the normal forces in two lists of contacts, for the pairs of grains that both lists contain.
struct ForceAgreement {
  /// Pearson's correlation coefficient of the two lists of forces. Absent if fewer than 3 pairs are in both lists, or
  /// if all forces of one list are equal.
  std::optional<double> pearson;
  int n_common = 0;  ///< number of pairs of grains that both lists contain
};
/// Compares the normal forces of two lists of contacts.
/// @param forces                  first list
/// @param contacts, normal_force  second list: contacts, and their normal forces (force)
template <int Dim>
ForceAgreement agreement(const std::vector<GrainForce<Dim>>& forces, const std::vector<Contact<Dim>>& contacts,
                         const std::vector<double>& normal_force);

}  // namespace floc
