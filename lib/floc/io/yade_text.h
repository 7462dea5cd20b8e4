#pragma once

#include <vector>

#include "floc/io/import.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// Whether a file's first line is a comment that names the columns x, y, z and r, or gives a cell.
bool is_yade_text(const std::string& path);

/// Whether a file's first line is a comment that names the columns id1 and id2.
bool is_yade_interactions(const std::string& path);

/// Reads spheres that a script of YADE wrote as text. Comment lines are
///   # cell ax ay az bx by bz cx cy cz     lattice vectors (columns of O.cell.hSize), unless `options.cell` is given
///   # id x y z r [mass]                   names of the columns; the comment of export.textExt(),
///                                         "\#format x_y_z_r", is accepted as well
/// Each further line is one sphere. Without names the columns are x y z r, and ids are counted from 0.
///
/// `options.contacts` may name a file (see read_contact_file()). Interactions name their columns in a comment:
///   id1 id2
///   cellx celly cellz    i.cellDist; without them the nearest image is taken
///   fnx fny fnz          i.phys.normalForce, the force on id2; in N if units are SI, like all other columns
///   fsx fsy fsz          i.phys.shearForce, also on id2
///   kn ks                i.phys.kn, i.phys.ks
///   tan_phi              i.phys.tangensOfFrictionAngle
/// Each further line is one interaction. Contacts keep their own stiffnesses. Without `options.law`, the law has the
/// means of the stiffnesses, and tan_phi, which then must be the same for all contacts.
/// @throws InputError naming file and line
Imported read_yade_text(const std::string& path, const ImportOptions& options);

/// Reads contacts from the interactions named by `options.contacts`.
/// @throws InputError naming file and line
std::vector<ListedContact> read_yade_contacts(const ImportOptions& options, int dimension);

}  // namespace floc
