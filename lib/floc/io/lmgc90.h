#pragma once

#include <string>

#include "floc/io/import.h"

namespace floc {

/// Whether `path` is a file BODIES.DAT, or a directory that contains one, such as the directory DATBOX of LMGC90.
bool is_lmgc90(const std::string& path);

/// Returns the path of the file BODIES.DAT of a packing of LMGC90. @param path  its directory or the file itself
std::string lmgc90_bodies(const std::string& path);

/// Reads a packing of disks (DISKx), spheres (SPHER), polygons (POLYG) or polyhedra (POLYR) from the directory DATBOX
/// of LMGC90: bodies (BODIES.DAT), their displacements (DOF.INI), densities and gravity (BULK_BEHAV.DAT), and contacts
/// with their forces (Vloc_Rloc.INI). The last three files may be missing. Bars (JONCx) and plates (PLANx) along an
/// axis are walls. The force on the candidate (first body) of a contact with the normal n is rln n + rlt t, with t =
/// (n2, -n1), in 2D, and rln n + rlt t + rls s in 3D. `options.law` is required. The files do not contain the periodic
/// directions, which are set in the script of a run; `options.cell` gives them.
/// @throws InputError naming file and line for a malformed file, or a body of another kind
Imported read_lmgc90(const std::string& path, const ImportOptions& options);

}  // namespace floc
