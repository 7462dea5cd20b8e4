#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "floc/lattice/cemented_sample.h"
#include "floc/network/contact_network.h"

namespace floc {

/// What joins two nodes.
enum class ElementKind : std::uint8_t {
  grain,      ///< within a grain
  matrix,     ///< within the matrix
  interface,  ///< a grain and the matrix
  bare,       ///< two grains, no matrix between
};
inline constexpr int kElementKinds = 4;
const char* name_of(ElementKind kind);

enum class BareContact {
  unilateral,  ///< pushes only, without friction
  bilateral,   ///< like any other element
  none,        ///< nothing
};

/// How the cell ends at its border.
enum class LatticeBoundary {
  periodic,        ///< nothing: the sample goes on
  plates,          ///< plates without friction on the faces across the loaded axis, other sides free
  bonded_plates,   ///< plates that hold what touches them in every direction
  uniform_strain,  ///< all nodes at the border follow the strain
};

/// Stiffness of the elements, from the phases of their ends: one Hooke constant per kind, whatever the length,
/// as in [RTV2010]; an interface is two springs of half the length in series, which makes laminates exact.
struct ElementStiffness {
  double grain = 1.0;               ///< k_p (force/length), or E (stress) where `by_facet`
  double matrix = 1.0;              ///< k_m
  std::optional<double> interface;  ///< absent: 2 k_p k_m/(k_p + k_m)
  std::optional<double> bare;       ///< of bare contacts; absent: k_p
  double shear = 0.0;               ///< K_T/K_N; 0: central springs
  double bending = 0.0;             ///< K_R/(K_N spacing^2)
  bool by_facet = false;            ///< k = E facet/length in place of a constant
  BareContact contact = BareContact::unilateral;
  /// Bare elements count if they are no farther from the line between the grains' centres than this times R' =
  /// 2 R_i R_j/(R_i + R_j); the others are void. Absent: all count, a patch that depends on the resolution.
  std::optional<double> patch;

  bool central() const { return shear == 0.0 && bending == 0.0; }
  /// Stiffness of a kind of element (force/length, or stress).
  double of(ElementKind kind) const;
  /// Every fault as "name = value: requirement".
  std::vector<std::string> validate() const;
};

template <int Dim>
struct LatticeElement {
  int i, j;
  Vec<Dim, int> image;
  Vec<Dim> branch;  ///< from i to the image of j (length)
  Vec<Dim> arm_i;   ///< from i to where the force acts (length)
  double kn;        ///< (force/length)
  ElementKind kind;
  bool unilateral;  ///< carries nothing when stretched, and resists no shear
  int bond = -1;    ///< of the lattice
};

/// A sample reduced to a network of springs.
template <int Dim>
struct LatticeNetwork {
  int n_nodes = 0;      ///< of the lattice; elements use its numbers
  double volume = 0.0;  ///< of the cell
  double spacing = 0.0;
  double shear = 0.0;    ///< K_T/K_N of elements that are not unilateral
  double bending = 0.0;  ///< K_R/(K_N spacing^2), likewise
  std::vector<LatticeElement<Dim>> elements;
  std::vector<bool> present;  ///< of each node: whether it has an element
  /// Displacements relative to the uniform strain that are held at zero: Dim entries per node, or empty: none.
  std::vector<bool> held;
  int n_removed = 0;  ///< nodes of grains or matrix that could carry nothing: cut off, or on a single line
  int n_islands = 0;  ///< parts apart from what carries the load, among these
  int n_directions =
      0;  ///< independent ways in which it winds around the cell; Dim where plates or the border hold it

  bool central() const { return shear == 0.0 && bending == 0.0; }
  int count(ElementKind kind) const;
};

/// Elements between the nodes of a sample, without those that cannot carry anything however it is loaded: at
/// nodes cut off, at nodes that hang on one element or (central) on a line, and in parts that neither wind
/// around the cell nor reach what holds it.
/// @param axis  that plates load along, from 0; ignored for other boundaries
/// @throws InputError with the faults of the stiffness
template <int Dim>
LatticeNetwork<Dim> lattice_network(const CementedSample<Dim>& sample, const ElementStiffness& stiffness,
                                    LatticeBoundary boundary = LatticeBoundary::periodic, int axis = Dim - 1);

/// The same elements as a contact network, with the nodes as its grains: the input of `elasticity`.
/// @param open  of each element, whether it is left out; empty: none
template <int Dim>
ContactNetwork<Dim> contact_network(const LatticeNetwork<Dim>& network, const std::vector<bool>& open = {});

}  // namespace floc
