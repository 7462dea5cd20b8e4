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
#include "floc/shape/manifold.h"

namespace floc {

/// A grain, as a file of another program lists it. In 2D the third component of every vector is ignored.
struct ListedGrain {
  FileLine place;                                          ///< "file:line", for messages
  std::int64_t id = 0;                                     ///< identifier, unique in the file
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< centre, which may lie outside the cell (length)
  Eigen::Vector3d position_low = Eigen::Vector3d::Zero();  ///< exact position in the file minus `position`
  double radius = 0.0;                                     ///< radius (length)
  /// Mass. If absent, the mass of a disk is diameter^2, and the mass of a sphere is diameter^3. In this case, a grain
  /// of another shape has the density of these disks or spheres.
  std::optional<double> mass;
  std::optional<ListedPose> pose;  ///< shape and orientation of a grain with corners, see set_shape()
};

/// A contact, as a file of another program lists it. Forces and moments act on grain id1. In 2D a moment is stored as
/// the third component of a vector. Members without a value in the file are empty.
struct ListedContact {
  FileLine place;
  std::int64_t id1 = 0;
  std::int64_t id2 = 0;          ///< identifier of the second grain; ignored if the second body is a wall
  std::optional<WallSide> wall;  ///< wall that grain id1 touches; if absent, grain id1 touches grain id2
  /// whether the contact is a bond; a bond acts at any gap, independent of the law
  bool bond = false;
  /// Whether grain id2 touches grain id1 across a boundary at which grains are rotated when they cross it. No lattice
  /// translation brings the two grains together. The contact keeps its force and has no stiffness.
  bool across_no_lattice = false;
  /// Periodic image of grain id2 that touches grain id1, in numbers of cells along the lattice vectors. The centre of
  /// this image is x[id2] + image * cell, where x[id2] is the position listed in the file. If absent, the image nearest
  /// to grain id1 is used.
  std::optional<Eigen::Vector3i> image;
  std::optional<Eigen::Vector3d> force;  ///< total force; replaces normal_force and shear_force
  /// normal force, positive in compression; if empty, the law gives it
  std::optional<double> normal_force;
  /// Position (length) of the contact point of grains with corners. The point may be near any periodic image of grain
  /// id1.
  std::optional<Eigen::Vector3d> point;
  std::optional<Eigen::Vector3d>
      /// direction from id1 to id2 at this point; if empty, it is computed from the shapes
      normal;
  std::optional<double> gap;  ///< gap at this point (length); if empty, it is computed from the shapes
  /// kind of the contact at this point; if empty, it follows from the shapes and from the number of points of the pair
  std::optional<ContactType> kind;
  std::optional<Eigen::Vector3d> shear_force;
  std::optional<Eigen::Vector3d> rolling_moment;
  std::optional<double> twisting_moment;  ///< twisting moment about the contact normal from id1 to id2
  std::optional<double> kn;               ///< normal stiffness (force/length)
  std::optional<double> kt;               ///< tangential stiffness (force/length)
  std::optional<double> kr;               ///< rolling stiffness (force * length)
  std::optional<double> ktw;              ///< twisting stiffness (force * length)
  Strengths strengths{};                  ///< strengths of the contact, stored in the state; 0: not given
  /// Volume (length^3) of the liquid bridge; negative if the bridge has broken.
  std::optional<double> bridge_volume;

  bool has_stiffness() const { return kn || kt || kr || ktw; }
};

/// A packing, as a file of another program lists it. Every reader of a file format fills a ListedPacking.
/// settle_space() computes the members cell, cell_place, ends and gravity from `space` and from the options of the
/// user.
struct ListedPacking {
  std::string place;  ///< name of the file, for messages
  ListedSpace space;  ///< cell, boundary, dimension and gravity in the file
  std::vector<ListedGrain> grains;
  ListedShapes shapes;
  std::optional<std::vector<ListedContact>> contacts;
  std::vector<ListedContact> bonds;  ///< contacts that act across gaps, in addition to `contacts`
  /// Contacts with walls in the file of the grains. A file of contacts may list more contacts with walls.
  std::vector<ListedContact> wall_contacts;
  /// Whether the packing has walls, but no contacts with walls are listed. If true, these contacts are found from the
  /// geometry.
  bool lacks_wall_contacts = false;
  Law law;
  std::optional<Law> wall_law;  ///< law of contacts with walls; if absent, `law` applies to them
  std::string units;            ///< "reduced" or "SI"
  /// time step of the grains. If a file of contacts contains several time steps, the contacts of this time step are
  /// read
  std::optional<std::int64_t> timestep;
  /// time of the grains. From an .fstat file of MercuryDPM, the contacts of this time are read
  std::optional<double> time;
  /// Whether the grains come from a restart file of MercuryDPM. An .fstat file then numbers them in the order of
  /// `grains`, not by their identifiers.
  bool in_order_of_fstat = false;
  bool drop_tensile = false;         ///< whether tensile contacts are left out, see ImportOptions
  std::vector<std::string> remarks;  ///< sentences for the user, see Imported
  std::vector<std::string> inconsistencies;

  std::string cell_place;  ///< line or option that gives the cell, for messages
  /// Lattice vectors of the cell (length), one per row. The number of vectors is the dimension.
  std::vector<std::vector<double>> cell;
  std::vector<ListedEnds> ends;  ///< ends of the axes that are not periodic, in ascending order of the axes
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
};

/// Returns a new ListedPacking for the file `path`. Sets `place` to the name of the file, and sets the laws, `units`
/// and `drop_tensile` from the options.
/// @throws InputError if the options give no contact law
ListedPacking listed_packing(const std::string& path, const ImportOptions& options);

/// Returns the contact law that the user gave with the option `--law`.
/// @throws InputError naming the file `path`, which contains no law, if the user gave no law
const Law& required_law(const std::string& path, const ImportOptions& options);

/// Adds `wall_contacts`, the contacts with walls in the file of the grains, to `contacts`, which must have a
/// value. If the packing then has walls but no contact with a wall, records that the contacts with walls must be found
/// from the geometry.
/// @param list  words for the list of contacts, for the remark that tells the user
void add_wall_contacts(const std::string& list, ListedPacking& listed);

/// Assembles a packing from listed grains and contacts. Grains are moved into the periodic cell. Contacts are sorted
/// and refer to grains by their indices instead of their identifiers. The contact law gives the forces and stiffnesses
/// that are not listed, and contact springs are stretched to the listed forces. All digits of listed forces are kept:
/// the component of `force` along the contact normal becomes the normal force, and the rest the tangential force. A
/// listed contact is left out if the grains do not touch, the listed forces are zero, and the gap is beyond the range
/// of the law. If the grains of a contact cannot touch at the listed image, the nearest image replaces it.
/// @throws InputError naming the place, the value and the expectation in these cases:
/// - grains and cell: no grains; a repeated identifier; a cell without volume;
/// - bodies of a contact: an unknown grain or wall; a contact of a grain with itself; a contact listed twice; a contact
/// without a listed image whose grains are half the width of the cell or more apart, so that two images may be equally
/// near, and whose point, if it is listed, lies at none or at several of them;
/// - grains with corners: a contact without a point, a normal whose length is not 1, a reversed normal;
/// - distances: a contact without a listed force whose gap is beyond the range of the law; a contact with a listed
/// force whose grains cannot touch at any near image;
/// - forces and stiffnesses: a contact of grains with corners without a point or a force; a tensile contact under a law
/// without adhesion (unless `drop_tensile`); an invalid stiffness; forces that contradict each other
Imported assemble(const ListedPacking& listed);

/// Assembles a packing from the ListedPacking that a reader has filled. Settles the space, reads the file of contacts
/// if the options name one, and calls the function above. The contacts in the file of contacts replace the member
/// `contacts`, and `wall_contacts` are added. If the packing then has walls but no contact with a wall, the contacts
/// with walls are found from the geometry.
/// @throws InputError under the conditions of settle_space(), read_contact_file() and assemble()
Imported assemble(ListedPacking listed, const ImportOptions& options);

}  // namespace floc
