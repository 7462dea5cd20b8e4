#pragma once

#include <string>

#include "floc/io/import.h"

namespace floc {

/// Whether `path` is a directory with a file BODIES.DAT, as the directory DATBOX of LMGC90, or such a file.
bool is_lmgc90(const std::string& path);

/// Path of the file BODIES.DAT of a packing of LMGC90. @param path  its directory or the file itself
std::string lmgc90_bodies(const std::string& path);

/// Reads a packing of disks (DISKx) or spheres (SPHER) from the directory DATBOX of LMGC90: bodies (BODIES.DAT), their
/// displacements (DOF.INI), densities and gravity (BULK_BEHAV.DAT), and contacts with their forces (Vloc_Rloc.INI). The
/// last three files may be missing. Bars (JONCx) along an axis are walls. The force on the candidate of a contact is
/// rln n + rlt t, in two dimensions with t = (n2, -n1), and in three rln n + rlt t + rls s. `options.law` is required. The
/// files do not state periodic directions, which the script of the run sets; `options.cell` gives them.
/// @throws InputError naming file and line for a malformed file, or a body of another kind
Imported read_lmgc90(const std::string& path, const ImportOptions& options);

}  // namespace floc
