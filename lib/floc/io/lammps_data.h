#pragma once

#include <string>

#include "floc/io/import.h"

namespace floc {

/// Whether a file has the lines of a LAMMPS data file: a number of atoms, xlo xhi, and Atoms.
bool is_lammps_data(const std::string& path);

/// Reads a data file of LAMMPS with atom_style sphere: rows "id type diameter density x y z [ix iy iz]". The box is
/// taken as periodic unless the title contains "boundary" with letters other than p, as lammps_data_text() writes it.
/// The mass is that of a sphere of the given density, also in 2D, as in LAMMPS. In 2D, which "dimension 2" in the
/// title or settle_space() decides, x, y and their part of the box are taken. `options.law` is required;
/// `options.contacts` may name a csv file, as in read_csv_packing().
/// @throws InputError naming file and line
Imported read_lammps_data(const std::string& path, const ImportOptions& options);

/// Returns a data file with atom_style sphere and every digit. LAMMPS requires the first lattice vector along x and
/// the second in the x-y plane, with tilts of at most half a side. Any other cell is rotated (a left-handed one is
/// also mirrored), and its vectors are replaced by shorter ones of the same lattice. In 2D z = 0. The title gives the
/// dimension and the periodic sides. If an identifier is below 1, all are replaced by 1, 2, ...
std::string lammps_data_text(const AnyState& state);

}  // namespace floc
