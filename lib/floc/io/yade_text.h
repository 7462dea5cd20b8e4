#pragma once

#include <vector>

#include "floc/io/import.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// Whether the first line of a file is a comment that contains the names of the columns x, y, z and r, or that gives a
/// cell or a wall.
bool is_yade_text(const std::string& path);

/// Whether the first line of a file is a comment that contains the names of the columns id1 and id2.
bool is_yade_interactions(const std::string& path);

/// Reads spheres that a script of YADE wrote as text, one per line. These comment lines are read:
///   # cell ax ay az bx by bz cx cy cz     lattice vectors (columns of O.cell.hSize), unless `options.cell` is given
///   # wall x- 0                           a wall, as data/packings/yade/export.py writes it. A packing without a cell
///                                         ends in free space where there is no wall
///   # gravity gx gy gz                    acceleration due to gravity
///   # id x y z r [mass]                   names of the columns; the comment of export.textExt(),
///                                         "\#format x_y_z_r", is accepted as well
/// If no comment names the columns, they are x y z r. If there is no column id, spheres are numbered from 0.
///
/// `options.contacts` may name a file of contacts: see read_contact_file(). In a file of interactions of YADE, with one
/// interaction per line, a comment names the columns:
///   id1 id2
///   cellx celly cellz    i.cellDist; without these columns the nearest image is taken
///   fnx fny fnz          i.phys.normalForce, the force on id2
///   fsx fsy fsz          i.phys.shearForce, also on id2
///   kn ks                i.phys.kn, i.phys.ks
///   tan_phi              i.phys.tangensOfFrictionAngle
/// All numbers in the two files are in the unit system `options.units`. Each contact keeps its listed stiffnesses.
/// Without `options.law`, the contact law follows from the contacts: its normal and tangential stiffness are the means
/// of kn and ks, and its friction coefficient is tan_phi, which must be the same for all contacts.
/// @throws InputError naming file and line
Imported read_yade_text(const std::string& path, const ImportOptions& options);

/// Reads contacts from the file `options.contacts`, which is a file of interactions of YADE.
/// @throws InputError naming file and line
std::vector<ListedContact> read_yade_contacts(const ImportOptions& options, int dimension);

}  // namespace floc
