#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "floc/base/range.h"
#include "floc/lattice/cemented_sample.h"
#include "floc/network/contact_network.h"

namespace floc {

/// Kind of an element of a lattice, according to the materials of the two nodes that it joins.
enum class ElementKind : std::uint8_t {
  grain,      ///< between two nodes of one grain
  matrix,     ///< between two nodes of the matrix
  interface,  ///< between a node of a grain and a node of the matrix
  bare,       ///< between nodes of two grains, without matrix in between
};
inline constexpr int kElementKinds = 4;  ///< number of kinds of elements
/// Returns "grain", "matrix", "interface" or "contact" (for ElementKind::bare).
const char* name_of(ElementKind kind);

/// Behaviour of bare elements, which join two grains without matrix in between.
enum class BareContact {
  unilateral,  ///< carries compression only, without friction
  bilateral,   ///< carries tension, compression and shear like any other element
  none,        ///< carries no force
};

/// Boundary condition of a lattice at the border of its cell.
enum class LatticeBoundary {
  periodic,        ///< no border: the sample continues in its periodic images
  plates,          ///< frictionless plates on the two faces across the loaded axis; the other faces are free
  bonded_plates,   ///< plates that fix the nodes on the two faces across the loaded axis in every direction
  uniform_strain,  ///< all nodes at the border of the cell move with the uniform strain of the cell
};

/// Stiffness of the elements of a lattice: one spring constant per kind of element, independent of the length of the
/// element, as in [RTV2010]. By default, an element across an interface has the stiffness of two springs of half the
/// length in series, one of each material. With this default, the stiffness of a laminate is exact.
struct ElementStiffness {
  /// stiffness k_p of elements within grains (force/length), or Young's modulus E (stress) if `by_facet`
  double grain = 1.0;
  double matrix = 1.0;  ///< stiffness k_m of elements within the matrix, in the same unit as `grain`
  std::optional<double> interface;  ///< stiffness of interfaces; 2 k_p k_m/(k_p + k_m) if absent
  std::optional<double> bare;       ///< stiffness of bare elements; k_p if absent
  double shear = 0.0;               ///< ratio K_T/K_N of tangential to normal stiffness; 0 for central springs
  double bending = 0.0;  ///< ratio K_R/(K_N spacing^2) of rolling stiffness K_R to normal stiffness K_N
  /// whether the stiffness of an element is E f/length, with Young's modulus E and the area f of the face between the
  /// cells of its nodes (LatticeBond::facet)
  bool by_facet = false;
  /// behaviour of bare elements, which join two grains without matrix
  BareContact contact = BareContact::unilateral;
  /// Largest distance of a bare element from the line between the centres of its two grains, divided by R' = 2 R_i
  /// R_j/(R_i + R_j), where R_i and R_j are the radii of the grains. Bare elements at larger distances are left out. If
  /// absent, all bare elements are springs, and the contact area depends on the spacing of the lattice.
  std::optional<double> patch;

  /// Range of stiffnesses and of their ratios K_T/K_N and K_R/(K_N spacing^2), apart from zero. Squares of numbers in
  /// this range and their products with a load neither overflow nor vanish.
  static constexpr NumberRange kRange{.least = 1e-60, .most = 1e60};
  /// Largest ratio of two stiffnesses that are not zero. With a larger ratio, the solver could not distinguish soft
  /// elements from missing elements.
  static constexpr double kLargestRatio = 1e8;

  bool central() const { return shear == 0.0 && bending == 0.0; }
  /// Returns the stiffness of elements of a given kind (force/length, or stress if `by_facet`).
  double of(ElementKind kind) const;
  /// Returns every invalid stiffness or ratio as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Element (spring) between two nodes of a lattice.
template <int Dim>
struct LatticeElement {
  int i, j;             ///< numbers of the two nodes
  Vec<Dim, int> image;  ///< periodic image of node j: branch = node[j] + image * cell.matrix - node[i]
  Vec<Dim> branch;      ///< vector from node i to the image of node j (length)
  Vec<Dim> arm_i;       ///< vector from node i to the point at which the force of the element acts (length)
  double kn;            ///< normal stiffness (force/length)
  ElementKind kind;
  bool unilateral;  ///< whether the element carries compression only (no tension, no shear)
  int bond = -1;    ///< index of the bond in Lattice::bonds from which the element was made
};

/// Cemented sample as a network of springs.
template <int Dim>
struct LatticeNetwork {
  int n_nodes = 0;  ///< number of nodes of the lattice, including nodes without elements
  /// Volume (2D: area) to which the stress refers: the volume of the cell; between plates, the section of the cell
  /// times the distance between the two layers of fixed nodes.
  double volume = 0.0;
  double spacing = 0.0;  ///< spacing of the lattice (length)
  double shear = 0.0;  ///< ratio K_T/K_N of tangential to normal stiffness of elements that are not unilateral
  /// ratio K_R/(K_N spacing^2) of elements that are not unilateral, with the rolling stiffness K_R
  double bending = 0.0;
  std::vector<LatticeElement<Dim>> elements;
  std::vector<bool> present;  ///< for each node, whether it has an element
  /// For each component of the displacement of each node (relative to the uniform strain), whether it is fixed at zero:
  /// Dim entries per node. Empty if no displacement is fixed.
  std::vector<bool> held;
  /// number of nodes (of grains or of the matrix) that were removed because they cannot carry a force
  int n_removed = 0;
  int n_islands = 0;  ///< number of connected parts that were removed because they cannot carry the load
  /// number of independent directions in which the network winds around the cell; equal to Dim if nodes are fixed by
  /// plates or at the border of the cell
  int n_directions = 0;

  bool central() const { return shear == 0.0 && bending == 0.0; }
  int count(ElementKind kind) const;
};

/// Returns the network of elements between the nodes of a sample, without the elements that carry no force under any
/// load. The following elements are left out:
/// - the element of a node with a single element and, if springs are central, the elements of a node with only two
///   collinear elements;
/// - the elements of connected parts that neither wind around the cell nor reach from one fixed side to the other.
///
/// @param axis  axis along which plates load the sample, from 0; ignored for other boundaries
/// @throws InputError if a stiffness is invalid
template <int Dim>
LatticeNetwork<Dim> lattice_network(const CementedSample<Dim>& sample, const ElementStiffness& stiffness,
                                    LatticeBoundary boundary = LatticeBoundary::periodic, int axis = Dim - 1);

/// Returns a lattice as a contact network: the nodes become grains, and the elements become contacts. The functions of
/// the folder `elasticity` accept this network.
/// @param open  for each element, whether it is open; open elements are left out. If empty, no element is left out
template <int Dim>
ContactNetwork<Dim> contact_network(const LatticeNetwork<Dim>& network, const std::vector<bool>& open = {});

}  // namespace floc
