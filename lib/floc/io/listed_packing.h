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
  Eigen::Vector3d position_low = Eigen::Vector3d::Zero();  ///< what the file's digits say beyond these doubles
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
  std::optional<Eigen::Vector3d> force;  ///< all of it: normal and tangential; or these two:
  std::optional<double> normal_force;    ///< positive in compression; none: follows from the law
  std::optional<Eigen::Vector3d> shear_force;
  std::optional<Eigen::Vector3d> rolling_moment;
  std::optional<double> twisting_moment;  ///< about the normal from id1 to id2
  std::optional<double> kn;               ///< none: the law's (force/length)
  std::optional<double> kt;
  std::optional<double> kr;   ///< (force * length); springs of rolling follow from the law's
  std::optional<double> ktw;  ///< the same of twisting
  /// Of the liquid at it, negative where the bridge has broken (length^3).
  std::optional<double> bridge_volume;

  bool has_stiffness() const { return kn || kt || kr || ktw; }
};

/// A packing as a file lists it.
struct ListedPacking {
  std::string place;       ///< the file
  std::string cell_place;  ///< where its cell was given, for messages
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

/// The law of `--law`. @throws InputError naming `path`, whose file does not say the law, if there is none.
const Law& required_law(const std::string& path, const ImportOptions& options);

/// Puts a packing together: identifiers become indices, grains are brought into the cell, contacts are
/// completed by the law and sorted, springs are stretched to the forces that were given. Forces are kept to the
/// last digit: the part of `force` along the branch is normal force, the rest tangential. Listed neighbours
/// that do not touch, carry nothing and are out of the law's reach are left out; an image at which two grains
/// cannot touch gives way to the nearest one.
/// @throws InputError naming place, value and what was expected: no grains, a repeated identifier, a cell
/// without volume; a contact of an unknown grain, listed twice, out of the law's reach where no force is listed
/// at all, with a force though no image of the grains is near, that pulls under a law without adhesion (unless
/// `drop_tensile`), or without an image where a branch of half the cell or more leaves two as near; a stiffness
/// that is none, forces that contradict each other.
Imported assemble(const ListedPacking& listed);

}  // namespace floc
