#pragma once

#include <string>

#include "floc/io/import.h"

namespace floc {

/// Whether a file is probably a data file of LAMMPS: it contains " atoms", a box ("xlo xhi" or " avec") and a line that
/// begins with "Atoms".
bool is_lammps_data(const std::string& path);

/// Reads a data file of LAMMPS with atom_style sphere. Each line of the section Atoms contains "id type diameter
/// density x y z [ix iy iz]". As in LAMMPS, the mass of a grain is the mass of a sphere of the given density, in 2D as
/// well as in 3D. The dimension and the boundary are read from the title (the first line of the file) if
/// lammps_data_text() has written them there. The box is periodic unless the title contains "boundary" with letters
/// other than p. If the title contains no dimension, settle_space() determines it. In 2D all z must be equal, and the
/// third lattice vector is ignored. `options.law` is required. `options.contacts` may name a file of contacts: see
/// read_contact_file().
/// @throws InputError naming file and line
Imported read_lammps_data(const std::string& path, const ImportOptions& options);

/// Returns a state as text of a LAMMPS data file with atom_style sphere. Numbers are printed with all digits that are
/// needed to read them back exactly. LAMMPS requires that the first lattice vector is along x, the second is in the x-y
/// plane, and the tilts are at most half a side. Any other cell is rotated (a left-handed cell is also mirrored), and
/// its lattice vectors are replaced by shorter vectors of the same lattice. In 2D z = 0. The title contains the
/// dimension and the periodic directions. If any identifier of a grain is below 1, all identifiers are replaced by 1,
/// 2, ...
std::string lammps_data_text(const AnyState& state);

}  // namespace floc
