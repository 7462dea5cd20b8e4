#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "floc/lattice/cemented_sample.h"
#include "floc/network/contact_network.h"

namespace floc {

/// Kind of an element of a lattice, by the materials of the two nodes that it joins.
enum class ElementKind : std::uint8_t {
  grain,      ///< within a grain
  matrix,     ///< within the matrix
  interface,  ///< between a grain and the matrix
  bare,       ///< between two grains, without matrix
};
inline constexpr int kElementKinds = 4;  ///< number of kinds of elements
/// Returns "grain", "matrix", "interface" or "contact" (for ElementKind::bare).
const char* name_of(ElementKind kind);

/// Behaviour of the elements that join two grains without matrix in between.
enum class BareContact {
  unilateral,  ///< carries compression only, without friction
  bilateral,   ///< carries force like any other element
  none,        ///< carries no force
};

/// Boundary condition of a lattice at the border of its cell.
enum class LatticeBoundary {
  periodic,        ///< no border: the sample continues in its periodic images
  plates,          ///< frictionless plates on the two faces across the loaded axis; other sides are free
  bonded_plates,   ///< plates on these faces that fix their nodes in every direction
  uniform_strain,  ///< all nodes at the border move with the uniform strain
};

/// Stiffness of the elements, by the materials of their nodes: one spring constant per kind of element, independent of
/// its length, as in [RTV2010]. An interface consists of two springs of half the length in series, which gives the
/// exact stiffness of laminates.
struct ElementStiffness {
  double grain =
      1.0;  ///< stiffness k_p within grains (force/length), or Young's modulus E (stress) if `by_facet`
  double matrix = 1.0;              ///< stiffness k_m within the matrix, in the same unit
  std::optional<double> interface;  ///< stiffness of interfaces; 2 k_p k_m/(k_p + k_m) if absent
  std::optional<double> bare;       ///< stiffness of bare contacts; k_p if absent
  double shear = 0.0;               ///< ratio K_T/K_N of tangential to normal stiffness; 0 for central springs
  double bending = 0.0;             ///< ratio K_R/(K_N spacing^2) with the rolling stiffness K_R
  bool by_facet = false;  ///< whether the stiffness of an element is E facet/length instead of a constant
  BareContact contact = BareContact::unilateral;  ///< behaviour of bare elements
  /// Largest distance of a bare element from the line between the grains' centres, over R' = 2 R_i R_j/(R_i + R_j) with
  /// the radii of the grains; bare elements farther away are voids. If absent, all bare elements count, so that the
  /// contact area depends on the resolution.
  std::optional<double> patch;

  bool central() const { return shear == 0.0 && bending == 0.0; }
  /// Returns the stiffness of a kind of element (force/length, or stress if `by_facet`).
  double of(ElementKind kind) const;
  /// Returns every invalid value as "name = value: requirement".
  std::vector<std::string> validate() const;
};

/// Element (spring) between two nodes of a lattice.
template <int Dim>
struct LatticeElement {
  int i, j;             ///< numbers of the two nodes
  Vec<Dim, int> image;  ///< image of node j, see LatticeBond
  Vec<Dim> branch;      ///< vector from node i to the image of node j (length)
  Vec<Dim> arm_i;       ///< vector from node i to the point at which the force acts (length)
  double kn;            ///< normal stiffness (force/length)
  ElementKind kind;
  bool unilateral;  ///< whether the element carries no tension and resists no shear
  int bond = -1;    ///< index of its bond in Lattice::bonds
};

/// Cemented sample as a network of springs.
template <int Dim>
struct LatticeNetwork {
  int n_nodes = 0;       ///< number of nodes of the lattice, whose indices the elements use
  double volume = 0.0;   ///< volume of the cell (2D: area)
  double spacing = 0.0;  ///< spacing of the lattice (length)
  double shear = 0.0;  ///< ratio K_T/K_N of tangential to normal stiffness, of elements that are not unilateral
  /// ratio K_R/(K_N spacing^2) with the rolling stiffness K_R, of elements that are not unilateral
  double bending = 0.0;
  std::vector<LatticeElement<Dim>> elements;
  std::vector<bool> present;  ///< whether each node has an element
  /// For each displacement relative to the uniform strain, whether it is fixed at zero: Dim entries per node; empty if
  /// no displacement is fixed.
  std::vector<bool> held;
  int n_removed = 0;  ///< number of nodes of grains or matrix removed because they cannot carry a force
  int n_islands = 0;  ///< number of removed parts that are not connected to the part that carries load
  int n_directions =
      /// number of independent directions in which the network winds around the cell; Dim if plates or the border fix
      /// it
      0;

  bool central() const { return shear == 0.0 && bending == 0.0; }
  int count(ElementKind kind) const;
};

/// Returns the network of elements between the nodes of a sample, without elements that cannot carry any force under
/// any load. These are elements at isolated nodes, at nodes with a single element or (for central springs) with
/// collinear elements only, and in parts that neither wind around the cell nor reach the fixed nodes.
/// @param axis  axis along which plates load the sample, from 0; ignored for other boundaries
/// @throws InputError if a stiffness is invalid
template <int Dim>
LatticeNetwork<Dim> lattice_network(const CementedSample<Dim>& sample, const ElementStiffness& stiffness,
                                    LatticeBoundary boundary = LatticeBoundary::periodic, int axis = Dim - 1);

/// Returns the elements of a lattice as a contact network whose grains are the nodes, for use by the functions of the
/// folder `elasticity`.
/// @param open  one entry per element: whether it is left out; if empty, no element is left out
template <int Dim>
ContactNetwork<Dim> contact_network(const LatticeNetwork<Dim>& network, const std::vector<bool>& open = {});

}  // namespace floc
