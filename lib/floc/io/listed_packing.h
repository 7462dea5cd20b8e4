#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "floc/io/file_line.h"
#include "floc/io/import.h"

namespace floc {

/// One grain as a file of another program lists it. In 2D the third component of every vector is ignored.
struct ListedGrain {
  FileLine place;                                          ///< "file:line", for messages
  std::int64_t id = 0;                                     ///< unique in the file
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< centre, inside the cell or not (length)
  Eigen::Vector3d position_low = Eigen::Vector3d::Zero();  ///< position in the file minus `position`
  double radius = 0.0;                                     ///< (length)
  std::optional<double> mass;                              ///< none: unit mass at unit diameter
};

/// One contact as a file lists it. Forces act on grain id1; in 2D a moment is the third component.
struct ListedContact {
  FileLine place;
  std::int64_t id1 = 0;
  std::int64_t id2 = 0;
  /// branch = x[id2] + image * cell - x[id1] with the positions of the file; none: the nearest image.
  std::optional<Eigen::Vector3i> image;
  std::optional<Eigen::Vector3d> force;  ///< total force; or else its two parts:
  std::optional<double> normal_force;    ///< positive in compression; none: given by the law
  std::optional<Eigen::Vector3d> shear_force;
  std::optional<Eigen::Vector3d> rolling_moment;
  std::optional<double> twisting_moment;  ///< about the normal from id1 to id2
  std::optional<double> kn;               ///< (force/length); none: given by the law
  std::optional<double> kt;
  std::optional<double> kr;   ///< (force * length)
  std::optional<double> ktw;  ///< twisting stiffness (force * length)
  /// Volume of the liquid bridge (length^3); negative if the bridge has broken.
  std::optional<double> bridge_volume;

  bool has_stiffness() const { return kn || kt || kr || ktw; }
};

/// A packing as a file lists it.
struct ListedPacking {
  std::string place;       ///< the file
  std::string cell_place;  ///< place where the cell is given, for messages
  /// Lattice vectors, one per row (length); their number is the dimension.
  std::vector<std::vector<double>> cell;
  Law law;
  std::string units;
  std::vector<ListedGrain> grains;
  std::optional<std::vector<ListedContact>> contacts;
  bool drop_tensile = false;         ///< see ImportOptions
  std::vector<std::string> remarks;  ///< see Imported
  std::vector<std::string> inconsistencies;
};

/// Returns the law given by `--law`. @throws InputError naming `path`, a file that does not contain the law, if none
/// is given
const Law& required_law(const std::string& path, const ImportOptions& options);

/// Assembles a packing from listed grains and contacts. Identifiers become indices, grains are moved into the cell,
/// contacts are completed by the law and sorted, and springs are stretched to the given forces. Forces are kept to
/// the last digit: the part of `force` along the branch becomes the normal force, the rest the tangential force. A
/// listed neighbour is dropped if it does not touch, carries no force and is outside the range of the law. An image
/// at which two grains cannot touch is replaced by the nearest one.
/// @throws InputError naming place, value and expectation: no grains, a repeated identifier, a cell without volume; a
/// contact of an unknown grain, a contact listed twice, a contact out of the range of the law in a list without any
/// forces, a contact with a force but without a near image of its grains, a tensile contact under a law without
/// adhesion (unless `drop_tensile`), or a contact without an image whose branch is half the cell or longer, so that
/// two images are equally near; an invalid stiffness; forces that contradict each other
Imported assemble(const ListedPacking& listed);

}  // namespace floc
