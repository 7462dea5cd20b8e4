#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "floc/io/file_line.h"
#include "floc/io/import.h"
#include "floc/io/listed_shapes.h"
#include "floc/io/listed_space.h"
#include "floc/packing/bond_strength.h"

namespace floc {

/// A grain as a file of another program lists it. In 2D the third component of every vector is ignored.
struct ListedGrain {
  FileLine place;                                          ///< "file:line", for messages
  std::int64_t id = 0;                                     ///< identifier, unique in the file
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< centre, which may lie outside the cell (length)
  Eigen::Vector3d position_low = Eigen::Vector3d::Zero();  ///< exact position in the file minus `position`
  double radius = 0.0;                                     ///< radius (length)
  /// Mass; if absent, diameter^2 (2D) or diameter^3 (3D) of a disk or sphere, and the density of such grains for others.
  std::optional<double> mass;
  std::optional<ListedPose> pose;  ///< shape and orientation of a grain with corners: see set_shape()
};

/// A contact as a file of another program lists it. Forces and moments act on grain id1. In 2D a moment is the third
/// component of its vector. Members for which the file has no value are empty.
struct ListedContact {
  FileLine place;
  std::int64_t id1 = 0;
  std::int64_t id2 = 0;          ///< ignored if the second body is a wall
  std::optional<WallSide> wall;  ///< wall that grain id1 touches; absent: the second body is grain id2
  bool bond = false;             ///< whether the contact is a bond, which acts whatever its gap and the law
  /// Whether grain id2 touches at an image that no lattice vector leads to. The contact keeps its force and has no stiffness.
  bool across_no_lattice = false;
  /// Periodic image of grain id2 that touches grain id1, in numbers of cells along the lattice vectors. The centre of
  /// this image is x[id2] + image * cell, where x[id2] is the position listed in the file. Empty: the image nearest to
  /// id1.
  std::optional<Eigen::Vector3i> image;
  std::optional<Eigen::Vector3d> force;  ///< total force, given instead of normal_force and shear_force
  std::optional<double> normal_force;    ///< positive in compression; if empty, the law gives it
  /// Place in space of the contact point of grains with corners (length), near an image of grain id1.
  std::optional<Eigen::Vector3d> point;
  std::optional<Eigen::Vector3d>
      normal;                 ///< direction from id1 to id2 at this point; if empty, that of the shapes
  std::optional<double> gap;  ///< gap at this point (length); if empty, that of the shapes
  bool edges = false;         ///< whether two edges cross at this point
  std::optional<Eigen::Vector3d> shear_force;
  std::optional<Eigen::Vector3d> rolling_moment;
  std::optional<double> twisting_moment;  ///< about the contact normal from id1 to id2
  std::optional<double> kn;               ///< normal stiffness (force/length)
  std::optional<double> kt;               ///< tangential stiffness (force/length)
  std::optional<double> kr;               ///< rolling stiffness (force * length)
  std::optional<double> ktw;              ///< twisting stiffness (force * length)
  Strengths strengths{};                  ///< strengths, which are kept with the state; 0: not given
  /// Volume of the liquid bridge (length^3); negative for a bridge that has broken.
  std::optional<double> bridge_volume;

  bool has_stiffness() const { return kn || kt || kr || ktw; }
};

/// A packing as a file of another program lists it: the record that every reader fills. settle_space() derives the members
/// cell, cell_place, ends and gravity from `space` and from the options of the user.
struct ListedPacking {
  std::string place;  ///< name of the file, for messages
  ListedSpace space;  ///< cell, boundary, dimension and gravity that the file states
  std::vector<ListedGrain> grains;
  ListedShapes shapes;
  std::optional<std::vector<ListedContact>> contacts;
  std::vector<ListedContact> bonds;  ///< contacts that act across gaps, in addition to `contacts`
  /// Contacts with walls that the file of the grains lists, in addition to those of a file of contacts.
  std::vector<ListedContact> wall_contacts;
  /// Whether the list of contacts has none with the walls of the packing, so that these are found from the geometry.
  bool lacks_wall_contacts = false;
  Law law;
  std::optional<Law> wall_law;           ///< law of contacts with walls; absent: `law`
  std::string units;                     ///< "reduced" or "SI"
  std::optional<std::int64_t> timestep;  ///< time step of the grains, which the file of contacts may name
  bool drop_tensile = false;             ///< whether tensile contacts are left out: see ImportOptions
  std::vector<std::string> remarks;      ///< sentences for the user: see Imported
  std::vector<std::string> inconsistencies;

  std::string cell_place;  ///< line or option that gives the cell, for messages
  /// Lattice vectors of the cell (length), one per row. The number of vectors is the dimension.
  std::vector<std::vector<double>> cell;
  std::vector<ListedEnds> ends;  ///< ends of the axes that are not periodic, in ascending order of the axes
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
};

/// Starts the record of the file `path`: its name and, from the options, its laws, units and treatment of tension.
/// @throws InputError if the options give no contact law
ListedPacking listed_packing(const std::string& path, const ImportOptions& options);

/// Returns the contact law that the user gave with the option `--law`.
/// @throws InputError naming the file `path`, which contains no law, if the user gave none
const Law& required_law(const std::string& path, const ImportOptions& options);

/// Assembles a packing from listed grains and contacts. Grains are moved into the periodic cell. Contacts refer to
/// grains by their indices instead of their identifiers and are sorted; the contact law gives the forces and
/// stiffnesses that are not listed, and contact springs are stretched to the listed forces. Listed forces are kept to
/// the last digit: the component of `force` along the contact normal becomes the normal force, the rest the tangential
/// force. A listed pair of grains is left out if the grains do not touch, carry no force, and have a gap beyond the
/// range of the law. If the grains of a contact cannot touch at the listed image, the nearest image replaces it.
/// @throws InputError naming the place, the value and the expectation in these cases: no grains, a repeated identifier,
/// a cell without volume; a contact of grains with corners without a point or a force; a contact of an unknown grain or wall, a contact listed twice, a contact out of the range of the law
/// in a list without any forces, a contact with a force although no near images of its grains can touch, a tensile
/// contact under a law without adhesion (unless `drop_tensile`), or a contact without an image whose grains are half
/// the cell or more apart, so that two images may be equally near; an invalid stiffness; forces that contradict each
/// other
Imported assemble(const ListedPacking& listed);

/// Assembles a packing from the record that a reader has filled: settles the space, reads the file of contacts if the
/// options name one, and calls the function above. Contacts of the file of contacts replace those in the record. If they
/// are contacts of grains alone, the contacts with walls are those of the record or are found from the geometry.
/// @throws InputError under the conditions of settle_space(), read_contact_file() and assemble()
Imported assemble(ListedPacking listed, const ImportOptions& options);

}  // namespace floc
