#pragma once

#include <string>

#include "floc/io/import.h"

namespace floc {

/// Whether `path` is a file BODIES.DAT, or a directory that contains one, such as the directory DATBOX of LMGC90.
bool is_lmgc90(const std::string& path);

/// Returns the path of the file BODIES.DAT of a packing of LMGC90. @param path  directory of the file, or the file
/// itself
std::string lmgc90_bodies(const std::string& path);

/// Reads a packing of disks (DISKx), spheres (SPHER), polygons (POLYG) or polyhedra (POLYR) from the directory DATBOX
/// of LMGC90: bodies (BODIES.DAT), their displacements (DOF.INI), densities and gravity (BULK_BEHAV.DAT), and contacts
/// with their forces (Vloc_Rloc.INI). The last three files may be missing. Bars (JONCx) and plates (PLANx) along an
/// axis are walls. Let n be the normal of a contact, t and s the two tangents in 3D, and t = (n2, -n1) the tangent in
/// 2D. The force on the first body (candidate) is rln n + rlt t in 2D, and rln n + rlt t + rls s in 3D, with the
/// numbers rln, rlt and rls in the file. `options.law` is required. The files do not contain the periodic directions,
/// which the script of a run sets; `options.cell` gives the periodic cell.
/// @throws InputError naming file and line for a malformed file, or for a body of another kind
Imported read_lmgc90(const std::string& path, const ImportOptions& options);

}  // namespace floc
