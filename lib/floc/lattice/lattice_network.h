#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "floc/lattice/cemented_sample.h"
#include "floc/network/contact_network.h"

namespace floc {

/// Kind of an element, by the materials of the two nodes that it joins.
enum class ElementKind : std::uint8_t {
  grain,      ///< within a grain
  matrix,     ///< within the matrix
  interface,  ///< between a grain and the matrix
  bare,       ///< between two grains, without matrix
};
inline constexpr int kElementKinds = 4;
const char* name_of(ElementKind kind);

/// Behaviour of the elements between two grains without matrix.
enum class BareContact {
  unilateral,  ///< carries compression only, without friction
  bilateral,   ///< carries force like any other element
  none,        ///< carries no force
};

/// Boundary condition at the border of the cell.
enum class LatticeBoundary {
  periodic,        ///< none: the sample continues in its periodic images
  plates,          ///< plates without friction on the faces across the loaded axis, other sides free
  bonded_plates,   ///< plates that hold the nodes at them in every direction
  uniform_strain,  ///< all nodes at the border move with the uniform strain
};

/// Stiffness of the elements, from the phases of their ends: one Hooke constant per kind, whatever the length,
/// as in [RTV2010]; an interface is two springs of half the length in series, which makes laminates exact.
struct ElementStiffness {
  double grain = 1.0;               ///< k_p (force/length), or E (stress) where `by_facet`
  double matrix = 1.0;              ///< k_m
  std::optional<double> interface;  ///< 2 k_p k_m/(k_p + k_m) if absent
  std::optional<double> bare;       ///< stiffness of bare contacts; k_p if absent
  double shear = 0.0;               ///< K_T/K_N; 0: central springs
  double bending = 0.0;             ///< K_R/(K_N spacing^2)
  bool by_facet = false;            ///< k = E facet/length in place of a constant
  BareContact contact = BareContact::unilateral;
  /// Bare elements count if their distance from the line between the grains' centres is at most this times R' =
  /// 2 R_i R_j/(R_i + R_j); the others are void. If absent, all count, which makes the contact area depend on
  /// the resolution.
  std::optional<double> patch;

  bool central() const { return shear == 0.0 && bending == 0.0; }
  /// Returns the stiffness of a kind of element (force/length, or stress where `by_facet`).
  double of(ElementKind kind) const;
  /// Every fault as "name = value: requirement".
  std::vector<std::string> validate() const;
};

template <int Dim>
struct LatticeElement {
  int i, j;
  Vec<Dim, int> image;
  Vec<Dim> branch;  ///< from i to the image of j (length)
  Vec<Dim> arm_i;   ///< from i to the point at which the force acts (length)
  double kn;        ///< (force/length)
  ElementKind kind;
  bool unilateral;  ///< whether it carries no tension and resists no shear
  int bond = -1;    ///< index of its bond in the lattice
};

/// A sample reduced to a network of springs.
template <int Dim>
struct LatticeNetwork {
  int n_nodes = 0;      ///< number of nodes of the lattice, whose indices the elements use
  double volume = 0.0;  ///< volume of the cell
  double spacing = 0.0;
  double shear = 0.0;    ///< K_T/K_N of elements that are not unilateral
  double bending = 0.0;  ///< K_R/(K_N spacing^2) of elements that are not unilateral
  std::vector<LatticeElement<Dim>> elements;
  std::vector<bool> present;  ///< whether each node has an element
  /// Whether each displacement relative to the uniform strain is held at zero: Dim entries per node; empty if
  /// none is.
  std::vector<bool> held;
  int n_removed = 0;  ///< nodes of grains or matrix removed because they cannot carry a force
  int n_islands = 0;  ///< parts among them that are not connected to the load-carrying part
  int n_directions =
      0;  ///< independent ways in which it winds around the cell; Dim where plates or the border hold it

  bool central() const { return shear == 0.0 && bending == 0.0; }
  int count(ElementKind kind) const;
};

/// Makes the elements between the nodes of a sample, without those that cannot carry any force under any load:
/// elements at nodes cut off, at nodes that hang on one element or (central) on a line, and in parts that
/// neither wind around the cell nor reach the nodes that are held.
/// @param axis  that plates load along, from 0; ignored for other boundaries
/// @throws InputError with the faults of the stiffness
template <int Dim>
LatticeNetwork<Dim> lattice_network(const CementedSample<Dim>& sample, const ElementStiffness& stiffness,
                                    LatticeBoundary boundary = LatticeBoundary::periodic, int axis = Dim - 1);

/// Returns the elements of a lattice as a contact network, with the nodes as its grains: the input of
/// `elasticity`.
/// @param open  one entry per element: whether it is left out; empty: none is
template <int Dim>
ContactNetwork<Dim> contact_network(const LatticeNetwork<Dim>& network, const std::vector<bool>& open = {});

}  // namespace floc
