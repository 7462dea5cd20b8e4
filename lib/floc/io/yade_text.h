#pragma once

#include <vector>

#include "floc/io/import.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// Whether a file's first line is a comment that names the columns x, y, z and r, or gives a cell.
bool is_yade_text(const std::string& path);

/// Whether a file's first line is a comment that names the columns id1 and id2.
bool is_yade_interactions(const std::string& path);

/// Reads spheres that a script of YADE wrote as text: comment lines
///   # cell ax ay az bx by bz cx cy cz     lattice vectors (columns of O.cell.hSize), without `options.cell`
///   # id x y z r [mass]                   names of the columns; that of export.textExt(),
///                                         "\#format x_y_z_r", will do
/// then one sphere per line; without names the columns are x y z r, and ids are counted from 0.
///
/// `options.contacts` may name a file (see read_contact_file()). Interactions name their columns in a comment:
///   id1 id2
///   cellx celly cellz    i.cellDist; without them the nearest image
///   fnx fny fnz          i.phys.normalForce, the force on id2, in N like all that follows if units are SI
///   fsx fsy fsz          i.phys.shearForce, on id2 too
///   kn ks                i.phys.kn, i.phys.ks
///   tan_phi              i.phys.tangensOfFrictionAngle
/// then one interaction per line. Contacts keep their own stiffnesses. Without `options.law` the law has their
/// means and tan_phi, which then has to be one number for all.
/// @throws InputError naming file and line.
Imported read_yade_text(const std::string& path, const ImportOptions& options);

/// Contacts of the interactions named by `options.contacts`.
/// @throws InputError naming file and line.
std::vector<ListedContact> read_yade_contacts(const ImportOptions& options, int dimension);

}  // namespace floc
