#pragma once

#include <vector>

#include "floc/io/import.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// Whether the first line of a file is a comment that names the columns x, y, z and r, or that gives a cell.
bool is_yade_text(const std::string& path);

/// Whether the first line of a file is a comment that names the columns id1 and id2.
bool is_yade_interactions(const std::string& path);

/// Reads spheres that a script of YADE wrote as text. Comment lines are
///   # cell ax ay az bx by bz cx cy cz     lattice vectors (columns of O.cell.hSize), unless `options.cell` is given
///   # id x y z r [mass]                   names of the columns; the comment of export.textExt(),
///                                         "\#format x_y_z_r", is accepted as well
/// Each other line is one sphere. If no comment names the columns, they are x y z r. Without a column id, spheres are
/// numbered from 0.
///
/// `options.contacts` may name a file of contacts: see read_contact_file(). If it is a file of interactions of YADE, a
/// comment names its columns:
///   id1 id2
///   cellx celly cellz    i.cellDist; without these columns the nearest image is taken
///   fnx fny fnz          i.phys.normalForce, the force on id2; in N if units are SI, like all other columns
///   fsx fsy fsz          i.phys.shearForce, also on id2
///   kn ks                i.phys.kn, i.phys.ks
///   tan_phi              i.phys.tangensOfFrictionAngle
/// Each other line is one interaction. Each contact keeps its listed stiffnesses. Without `options.law`, the
/// stiffnesses of the contact law are the means over the contacts, and its friction coefficient is tan_phi, which then
/// has to be the same for all contacts.
/// @throws InputError naming file and line
Imported read_yade_text(const std::string& path, const ImportOptions& options);

/// Reads contacts from the file of interactions of YADE named by `options.contacts`.
/// @throws InputError naming file and line
std::vector<ListedContact> read_yade_contacts(const ImportOptions& options, int dimension);

}  // namespace floc
