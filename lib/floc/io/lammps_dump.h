#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "floc/io/import.h"
#include "floc/io/listed_packing.h"

namespace floc {

/// Whether a file is probably a dump of LAMMPS: it begins with "ITEM: ".
bool is_lammps_dump(const std::string& path);

/// Reads grains from one frame of a file that the command `dump custom` of LAMMPS wrote. The number of the frame is
/// `options.index` (from 0); without this option, the last frame is read. The columns are x y [z] (or xu yu [zu], or
/// the scaled positions xs ys [zs] or xsu ysu [zsu]), radius or diameter and, optionally, id and mass.
/// `options.columns` renames the columns. The box may be triclinic. The packing is periodic along the axes with the
/// boundary pp; `options.cell` replaces the box. settle_space() decides the dimension; in 2D all z have to be equal,
/// and the third lattice vector is ignored. `options.law` is required. If `options.columns` maps the name of a wall to
/// a fix, such as "x-" to "f_W", the contacts of this wall are read from the columns of the fix: see
/// wall_contacts_of().
///
/// `options.contacts` may name a file of contacts: see read_contact_file(). In a `dump local`, the last frame with the
/// time step of the grains is read. The columns of a `dump local` have the names of the computes of LAMMPS that
/// produced them. `options.contact_columns` maps the names that floc uses to the names in the dump. For example, the
/// commands
///
///   compute pair all property/local patom1 patom2 cutoff radius
///   compute force all pair/local fx fy fz p1 p2 p3 cutoff radius
///   dump contacts all local 1 FILE c_pair[1] c_pair[2] c_force[1] ... c_force[6]
///
/// write a dump that is read with id1=c_pair[1], id2=c_pair[2], force1=c_force[1], .. force3, shear_force1=c_force[4],
/// .. shear_force3. For granular pair styles, the compute pair/local gives the normal force (fx fy fz) and the
/// tangential force (p1 p2 p3). Both act on the first atom.
/// @throws InputError naming file and line
Imported read_lammps_dump(const std::string& path, const ImportOptions& options);

/// Reads contacts from the file `options.contacts`, which a `dump local` of LAMMPS wrote. If a time step is given,
/// reads the last frame with this time step, else the last frame.
/// @throws InputError naming file and line
std::vector<ListedContact> read_dump_contacts(const ImportOptions& options, int dimension,
                                              std::optional<std::int64_t> timestep);

}  // namespace floc
