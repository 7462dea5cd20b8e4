#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "floc/io/file_line.h"
#include "floc/io/import.h"

namespace floc {

/// One grain as listed in a file of another program. In 2D the third component of every vector is ignored.
struct ListedGrain {
  FileLine place;                                          ///< "file:line", for messages
  std::int64_t id = 0;                                     ///< identifier, unique in the file
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< centre, inside the cell or not (length)
  Eigen::Vector3d position_low = Eigen::Vector3d::Zero();  ///< exact position in the file minus `position`
  double radius = 0.0;                                     ///< radius (length)
  std::optional<double> mass;                              ///< if absent, diameter^2 in 2D, diameter^3 in 3D
};

/// One contact as listed in a file of another program. Forces and moments act on grain id1. In 2D a moment is the third
/// component of its vector. A member that the file does not give is absent.
struct ListedContact {
  FileLine place;
  std::int64_t id1 = 0;
  std::int64_t id2 = 0;
  /// Image of grain id2: its centre is x[id2] + image * cell, with the positions of the file. If absent, the image
  /// nearest to id1.
  std::optional<Eigen::Vector3i> image;
  std::optional<Eigen::Vector3d> force;  ///< total force, instead of normal_force and shear_force
  std::optional<double> normal_force;    ///< positive in compression; if absent, given by the law
  std::optional<Eigen::Vector3d> shear_force;
  std::optional<Eigen::Vector3d> rolling_moment;
  std::optional<double> twisting_moment;  ///< about the normal from id1 to id2
  std::optional<double> kn;               ///< normal stiffness (force/length); if absent, given by the law
  std::optional<double> kt;               ///< tangential stiffness (force/length)
  std::optional<double> kr;               ///< rolling stiffness (force * length)
  std::optional<double> ktw;              ///< twisting stiffness (force * length)
  /// Volume of the liquid bridge (length^3); negative if the bridge has broken.
  std::optional<double> bridge_volume;

  bool has_stiffness() const { return kn || kt || kr || ktw; }
};

/// A packing as listed in a file of another program.
struct ListedPacking {
  std::string place;       ///< name of the file, for messages
  std::string cell_place;  ///< place where the cell is given, for messages
  /// Lattice vectors, one per row (length); their number is the dimension.
  std::vector<std::vector<double>> cell;
  Law law;
  std::string units;
  std::vector<ListedGrain> grains;
  std::optional<std::vector<ListedContact>> contacts;
  bool drop_tensile = false;         ///< whether tensile contacts are dropped: see ImportOptions
  std::vector<std::string> remarks;  ///< sentences for the user: see Imported
  std::vector<std::string> inconsistencies;
};

/// Returns the contact law that the user gave with `--law`. @throws InputError naming the file `path`, which contains
/// no law, if the user gave none
const Law& required_law(const std::string& path, const ImportOptions& options);

/// Assembles a packing from listed grains and contacts. Identifiers become indices, grains are moved into the cell,
/// contacts are completed by the law and sorted, and contact springs are stretched to the listed forces. Listed forces
/// are kept to the last digit: the component of `force` along the contact normal becomes the normal force, the rest the
/// tangential force. A listed pair of grains is dropped if the grains do not touch, carry no force and are beyond the
/// range of the law. An image at which two grains cannot touch is replaced by the nearest image.
/// @throws InputError naming place, value and expectation: no grains, a repeated identifier, a cell without volume; a
/// contact of an unknown grain, a contact listed twice, a contact out of the range of the law in a list without any
/// forces, a contact with a force but without a near image of its grains, a tensile contact under a law without
/// adhesion (unless `drop_tensile`), or a contact without an image whose grains are half the cell or more apart, so
/// that two images may be equally near; an invalid stiffness; forces that contradict each other
Imported assemble(const ListedPacking& listed);

}  // namespace floc
